#pragma once

#include <vector>

#include "PlaneSearch.h"

namespace omnimapper::perception::clouds {

/// A surface on a plane.
struct PlanePatch {
  std::vector<int> members;  ///< indices of points
  CloudPlane result;
};

/// Finds the surfaces on a plane that have at least `options.min_points` points. Sets the flag in `used` of their
/// points, and of points that are a little farther from the plane but within the cells of a surface.
std::vector<PlanePatch> findPatches(const LoosePoints& points, const geometry::Plane3& plane,
                                    const CloudPlaneOptions& options, std::vector<bool>& used);

}  // namespace omnimapper::perception::clouds
