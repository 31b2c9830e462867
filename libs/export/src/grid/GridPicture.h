#pragma once

#include <mrpt/math/TPoint3D.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Image.h>

#include <vector>

#include "grid/ScanGrid.h"

namespace omnimapper::exports {

/// A grid as a picture, +y up, in the colours of the project: free light, walls dark.
struct GridPicture {
  draw::PaletteImage image;
  double metres_per_pixel = 0;
  double min_x = 0, max_y = 0;  ///< [m] outer corner of the upper left pixel

  draw::PixelPoint pixelOf(double x, double y) const {
    return {(x - min_x) / metres_per_pixel, (max_y - y) / metres_per_pixel};
  }
  double maxX() const { return min_x + image.width * metres_per_pixel; }
  double minY() const { return max_y - image.height * metres_per_pixel; }
};

/// One pixel for each cell.
GridPicture drawGrid(const ScanGrid& grid);
/// Scaled by whole numbers so that the longer side comes near `side` pixels. Where several cells fall on one pixel, it
/// is as light as many of them are known, and black if a wall one cell wide goes through, so that walls stay closed,
/// thin and smooth.
GridPicture drawGridToSize(const ScanGrid& grid, int side);

/// The part of a grid that holds what is known and the given places [m]. To each of the four sides the outermost 0.5 %
/// of what is known are left out where they reach out by more than a tenth of the rest: a few beams through windows do
/// not make a picture of a building small. Around it lies a margin, unknown where the grid ends, wide enough at the
/// lower side that the scale bar covers nothing.
ScanGrid focused(const ScanGrid& grid, const std::vector<mrpt::math::TPoint3D>& places);

}  // namespace omnimapper::exports
