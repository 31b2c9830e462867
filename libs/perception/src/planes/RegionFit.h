#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/DepthNoise.h>
#include <omnimapper/perception/PlaneRegion.h>

#include <vector>

#include "CellRegions.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

/// A region to the pixel: a connected component of pixels, and the plane fitted to all of them.
struct FittedRegion {
  int component = 0;
  ImagePlane plane;
  PlaneRegion result;  ///< without contours
};

/// Fits the plane of each component with at least `min_pixels` that are not all in one line; the one with most pixels
/// first.
std::vector<FittedRegion> fitRegions(const InverseDepth& inverse, const Pinhole& camera, const DepthNoise& noise,
                                     const Components& components, const PixelLabels& labels,
                                     const CellRegions& regions, int min_pixels);

}  // namespace omnimapper::perception::planes
