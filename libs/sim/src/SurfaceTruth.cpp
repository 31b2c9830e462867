#include "SurfaceTruth.h"

#include <omnimapper/geometry/Polygon3.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace omnimapper::sim {

namespace {

constexpr double kCell = 0.05;      // [m]
constexpr double kOnPlane = 0.001;  // [m] distance of a point from its plane; points are in single precision

std::vector<Eigen::Vector3d> moved(std::vector<Eigen::Vector3d> walk, const geometry::Se3& map_from_body) {
  for (auto& point : walk) point = map_from_body * point;
  return walk;
}

}  // namespace

SurfaceTruth::SurfaceTruth(const World& world) : world_(world), patches_(findPatches(world)) {
  const auto refs = numberSurfaces(world);
  patch_of_.resize(refs.size());
  for (const auto& ref : refs) body_of_.push_back(ref.body);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    seen_.push_back(surfaces::CellGrid::around(patch.plane_in_body, patch.part_in_body.outline, kCell));
    patch_of_[static_cast<std::size_t>(patch.surface)].push_back(i);
  }
}

void SurfaceTruth::add(const std::vector<VisiblePoint>& seen, double time) {
  std::vector<std::optional<geometry::Se3>> body_from_map(world_.bodies.size());
  for (const VisiblePoint& point : seen) {
    const auto surface = static_cast<std::size_t>(point.surface);
    if (patch_of_[surface].empty()) continue;
    const auto body = static_cast<std::size_t>(body_of_[surface]);
    if (!body_from_map[body]) {
      const auto map_from_body = world_.bodies[body].track.at(time);
      if (!map_from_body) continue;  // carried away between the stamp and a later beam
      body_from_map[body] = inverse(*map_from_body);
    }
    const Eigen::Vector3d in_body = *body_from_map[body] * point.in_map.cast<double>();
    for (const std::size_t i : patch_of_[surface]) {
      if (std::abs(signedDistance(patches_[i].plane_in_body, in_body)) > kOnPlane) continue;
      if (const auto cell = seen_[i].cellAt(in_body)) seen_[i].set(*cell);
    }
  }
}

surfaces::SurfaceSet SurfaceTruth::surfaces(const std::string& title) const {
  const auto refs = numberSurfaces(world_);
  surfaces::SurfaceSet set;
  set.title = title;
  set.openings = world_.openings;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    const Body& body = world_.bodies[static_cast<std::size_t>(patch.body)];
    const auto map_from_body = body.track.at(0);
    if (!map_from_body) continue;
    surfaces::Surface& surface = set.surfaces.emplace_back();
    surface.id = static_cast<int>(i) + 1;
    surface.name = patch.name;
    surface.body = body.name;
    surface.is = body.surfaces[static_cast<std::size_t>(refs[static_cast<std::size_t>(patch.surface)].surface)].is;
    surface.plane = *map_from_body * patch.plane_in_body;
    surfaces::FlatPart& part = surface.parts.emplace_back();
    part.outline = moved(patch.part_in_body.outline, *map_from_body);
    for (const auto& hole : patch.part_in_body.holes) part.holes.push_back(moved(hole, *map_from_body));
    const surfaces::CellGrid seen = seen_[i].movedBy(*map_from_body);
    surface.seen = seen.count() > 0 ? seen : surfaces::CellGrid(seen.origin(), seen.u(), seen.v(), seen.cell(), 0, 0);
    surface.is_moved = !body.track.isFixed();
  }
  return set;
}

}  // namespace omnimapper::sim
