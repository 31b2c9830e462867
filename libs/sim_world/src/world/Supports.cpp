#include "Supports.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>

namespace omnimapper::sim {

using Eigen::Vector3d;

namespace {

constexpr double kContact = 1e-4;  // surfaces of two bodies up to this far apart or into one another touch [m]

// The part of a convex polygon above a height, or below it if `sign` is -1.
std::vector<Vector3d> cutAt(const std::vector<Vector3d>& polygon, double height, double sign) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double above_a = sign * (a.z() - height), above_b = sign * (b.z() - height);
    if (above_a >= 0) kept.push_back(a);
    if ((above_a > 0 && above_b < 0) || (above_a < 0 && above_b > 0))
      kept.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept;
}

}  // namespace

std::optional<Support::Level> Support::at(double time) const {
  const auto pose = map_from_carrier.at(time);
  if (!pose) return {};
  Level level;
  for (const Vector3d& p : outline_in_carrier) {
    const Vector3d in_map = *pose * p;
    level.outline_in_map.push_back(in_map.head<2>());
    level.z = in_map.z();
  }
  return level;
}

void Supports::addFurniture(const Body& furniture) {
  const auto pose = furniture.track.at(0);
  if (!pose) return;
  for (const Surface& surface : furniture.surfaces) {
    if (!surface.face || (*pose * surface.face->plane_in_body).normal.z() < 1 - 1e-9) continue;
    supports_.insert_or_assign(
        surface.name, Support{surface.name, furniture.name, false, surface.face->outline_in_body, furniture.track});
    triangles_in_map_.try_emplace(furniture.name);
  }
  const auto found = triangles_in_map_.find(furniture.name);
  if (found == triangles_in_map_.end()) return;
  for (const Triangle& triangle : furniture.triangles) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = *pose * furniture.vertices_in_body[static_cast<std::size_t>(triangle.corners[i])];
    found->second.push_back(corners);
  }
}

void Supports::addObject(const std::string& name, const LevelTop& top, const Track& track) {
  Support support{name + "/top", name, true, {}, track};
  for (const Eigen::Vector2d& p : top.outline_in_body) support.outline_in_carrier.emplace_back(p.x(), p.y(), top.z);
  supports_.insert_or_assign(support.name, std::move(support));
}

const Support* Supports::find(const std::string& name) const {
  const auto found = supports_.find(name);
  return found == supports_.end() ? nullptr : &found->second;
}

std::vector<std::string> Supports::names() const {
  std::vector<std::string> names;
  for (const auto& [name, support] : supports_) names.push_back(name);
  return names;
}

bool Supports::reachesInto(const std::string& furniture, const Footprint& space) const {
  const auto found = triangles_in_map_.find(furniture);
  if (found == triangles_in_map_.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(), [&](const Corners& corners) {
    const std::vector<Vector3d> above = cutAt({corners.begin(), corners.end()}, space.low_z + kContact, 1);
    const std::vector<Vector3d> between = cutAt(above, space.high_z - kContact, -1);
    Ring seen_from_above;
    for (const Vector3d& p : between) seen_from_above.push_back(p.head<2>());
    return !between.empty() && convexOverlap(geometry::convexHull(std::move(seen_from_above)), space.outline_in_map);
  });
}

}  // namespace omnimapper::sim
