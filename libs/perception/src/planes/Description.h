#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlaneRegion.h>

#include "CellRegions.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

struct DescriptionLimits {
  int min_pixels = 0;       ///< fewest pixels of a region
  int min_hole_pixels = 0;  ///< smaller holes are not outlined
  double max_depth = 0;     ///< [m]; outlines reach at most twice as far
};

/// Sets the labels of all pixels outside the components to 0.
void clearOthers(const Components& components, PixelLabels& labels);

/// Fits a plane to each connected component of labelled pixels and traces its outlines. All pixels of a component have
/// the same label; label - 1 is the index in `regions` of the plane that the fit starts from.
PlaneSegmentation describe(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                           const CellRegions& regions, PixelLabels labels, const Components& components,
                           const DescriptionLimits& limits);

}  // namespace omnimapper::perception::planes
