#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlaneRegion.h>

#include "CellRegions.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

struct DescriptionLimits {
  int min_pixels = 0;       ///< of a region
  int min_hole_pixels = 0;  ///< smaller holes are not outlined
  double max_depth = 0;     ///< [m]
};

/// Pixels of no component lose their labels.
void clearOthers(const Components& components, PixelLabels& labels);

/// Connected components of all labelled pixels, each with labels that are equal, as planes: fitted to the pixel,
/// starting from those of `regions` (label - 1 is the index), with traced outlines.
PlaneSegmentation describe(const InverseDepth& inverse, const Pinhole& camera, const DepthNoise& noise,
                           const CellRegions& regions, PixelLabels labels, const Components& components,
                           const DescriptionLimits& limits);

}  // namespace omnimapper::perception::planes
