#pragma once

#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlaneRegion.h>

#include <vector>

#include "CellRegions.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

/// A connected component of pixels and the plane fitted to all of them.
struct FittedRegion {
  int component = 0;
  ImagePlane plane;
  PlaneRegion result;  ///< without contours
};

/// Fits a plane to each component with at least `min_pixels` pixels that are not collinear. The plane with the most
/// pixels comes first.
std::vector<FittedRegion> fitRegions(const InverseDepth& inverse, const camera::Pinhole& camera,
                                     const camera::DepthNoise& noise, const Components& components,
                                     const PixelLabels& labels, const CellRegions& regions, int min_pixels);

}  // namespace omnimapper::perception::planes
