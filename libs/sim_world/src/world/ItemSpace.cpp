#include "ItemSpace.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kFootHeight = 0.001;  // points up to this height are parts of the foot [m]

double reachFrom(const Vector2d& point, const Ring& ring) {
  double reach = 0;
  for (const Vector2d& corner : ring) reach = std::max(reach, (corner - point).norm());
  return reach;
}

}  // namespace

ItemSpace spaceOf(const Body& body) {
  ItemSpace space;
  for (const Vector3d& p : body.vertices_in_body) {
    space.outline.push_back(p.head<2>());
    if (p.z() <= kFootHeight) space.foot.push_back(p.head<2>());
    space.height = std::max(space.height, p.z());
  }
  space.outline = geometry::convexHull(std::move(space.outline));
  space.foot = geometry::convexHull(std::move(space.foot));
  return space;
}

ItemSpace boxSpace(const Vector3d& extents) {
  const Ring outline = rectangle(Vector2d::Zero(), extents.x(), extents.y());
  return {outline, outline, extents.z()};
}

Ring outlineAt(const Ring& outline_in_item, const geometry::Se3& map_from_item) {
  Ring outline;
  for (const Vector2d& p : outline_in_item) outline.push_back((map_from_item * Vector3d(p.x(), p.y(), 0)).head<2>());
  return outline;
}

Vector2d firstFreePosition(const Ring& outline, const Ring& other, const Vector2d& from, const Vector2d& direction) {
  constexpr int kHalvings = 60;
  double overlaps = 0, is_free = reachFrom(from, other) + reachFrom(Vector2d::Zero(), outline);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (overlaps + is_free) / 2;
    Ring moved = outline;
    for (Vector2d& p : moved) p += from + middle * direction;
    (convexOverlap(moved, other) ? overlaps : is_free) = middle;
  }
  return from + is_free * direction;
}

}  // namespace omnimapper::sim
