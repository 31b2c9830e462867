#pragma once

#include <vector>

#include "PlaneSearch.h"

namespace omnimapper::perception::clouds {

/// A surface on a plane.
struct PlanePatch {
  std::vector<int> members;  ///< points of the cloud that are left
  CloudPlane result;
};

/// The surfaces of at least `options.min_points` points that lie on a plane, from the first one on. Sets the flag of
/// their points, and of those that are a little farther off within their outline.
std::vector<PlanePatch> findPatches(const LoosePoints& points, const geometry::Plane3& plane,
                                    const CloudPlaneOptions& options, std::vector<bool>& used);

}  // namespace omnimapper::perception::clouds
