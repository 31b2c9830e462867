#pragma once

#include <omnimapper/sim_world/Body.h>
#include <omnimapper/sim_world/Footprint.h>

namespace omnimapper::sim {

/// The space that an item fills, in its own frame: origin in the middle of its lowest face, z up.
struct ItemSpace {
  Ring outline;  ///< convex, of the whole item seen from above [m]
  /// The same of the points on which it stands; two corners or one if these are on a line or coincide [m].
  Ring foot;
  double height = 0;  ///< [m]
};
ItemSpace spaceOf(const Body& body);
/// The space of a box with these extents.
ItemSpace boxSpace(const Eigen::Vector3d& extents);

/// An outline of an item that stands at a pose, seen from above.
Ring outlineAt(const Ring& outline_in_item, const geometry::Se3& map_from_item);

/// The position that a convex outline has when it is moved along a line from `from` until it touches another convex
/// outline and no longer overlaps it. `outline` is relative to its position, `direction` a unit vector, and `from` lies
/// in `other`.
Eigen::Vector2d firstFreePosition(const Ring& outline, const Ring& other, const Eigen::Vector2d& from,
                                  const Eigen::Vector2d& direction);

}  // namespace omnimapper::sim
