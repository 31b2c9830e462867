#pragma once

#include <omnimapper/perception/PlaneRegion.h>

#include "CellRegions.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

struct DescriptionLimits {
  int min_pixels = 0;       ///< of a region
  int min_hole_pixels = 0;  ///< smaller holes are not outlined
  double max_depth = 0;     ///< [m]
};

/// The connected components of pixels with equal labels as planes: fitted to the pixel, starting from those of
/// `regions` (label - 1 is the index), with traced outlines.
PlaneSegmentation describe(const InverseDepth& inverse, const Pinhole& camera, const DepthNoise& noise,
                           const CellRegions& regions, PixelLabels labels, const DescriptionLimits& limits);

}  // namespace omnimapper::perception::planes
