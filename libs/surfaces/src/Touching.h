#pragma once

#include <omnimapper/surfaces/SurfaceFacts.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::surfaces {

inline constexpr double kTouch = 0.12;  ///< [m] largest distance at which edges of touching surfaces are seen

/// Direction of an upright plane along the floor.
inline Eigen::Vector2d alongFloor(const geometry::Plane3& plane) {
  return Eigen::Vector2d(-plane.normal.y(), plane.normal.x()).normalized();
}

inline bool overlapInHeight(const SurfaceFacts& a, const SurfaceFacts& b) {
  return a.bottom < b.top + kTouch && b.bottom < a.top + kTouch;
}

/// Whether upright `side`, nearly at right angles to the upright surface, meets it at one of its ends.
inline bool meetAtEnd(const Surface& surface, const SurfaceFacts& facts, const Surface& side,
                      const SurfaceFacts& of_side) {
  constexpr double kAcross = 0.3;  // largest cosine of the angle between their normals
  if (of_side.lie != Lie::upright || std::abs(side.plane.normal.dot(surface.plane.normal)) > kAcross) return false;
  const double at = alongFloor(surface.plane).dot(of_side.middle.head<2>());  // nearly all of it is there
  return std::min(std::abs(at - facts.along.x()), std::abs(at - facts.along.y())) < 2 * kTouch;
}

/// Whether most of the other surface lies behind this one, on the side that is not seen.
inline bool liesBehind(const Surface& surface, const SurfaceFacts& other) {
  return signedDistance(surface.plane, other.middle) < 0;
}

}  // namespace omnimapper::surfaces
