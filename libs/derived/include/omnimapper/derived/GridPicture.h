#pragma once

#include <mrpt/math/TPoint3D.h>
#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Image.h>

#include <vector>

namespace omnimapper::derived {

/// A grid as a picture, +y up, in the colours of the project: free space light, walls dark.
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

/// Draws the grid with one pixel for each cell.
GridPicture drawGrid(const ScanGrid& grid);
/// Draws the grid scaled by a whole number so that the longer side is close to `side` pixels. A pixel that covers
/// several cells is the lighter the more of them are known, and black if a wall one cell wide passes through it, so
/// that walls stay closed, thin and smooth.
GridPicture drawGridToSize(const ScanGrid& grid, int side);

/// The part of a grid that contains the known cells and the given places [m]. At each side the outermost 0.5 % of the
/// known cells are cut off if that shortens the picture by more than a tenth of the rest, so that a few beams through
/// windows do not make a building small in the picture. A margin surrounds this part, unknown outside the grid, and
/// wide enough at the lower side for the scale bar.
ScanGrid focused(const ScanGrid& grid, const std::vector<mrpt::math::TPoint3D>& places);

}  // namespace omnimapper::derived
