#include "SurfaceTruth.h"

#include <omnimapper/geometry/Polygon3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace omnimapper::sim {

namespace {

constexpr double kCell = 0.05;      // [m]
constexpr double kOnPlane = 0.001;  // [m] distance of a point from its plane; points are in single precision

template <class Number>
void put(std::ostream& out, Number number) {
  char bytes[sizeof(Number)];
  std::copy_n(reinterpret_cast<const char*>(&number), sizeof number, bytes);
  out.write(bytes, sizeof bytes);
}

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

void writeMesh(std::ostream& out, const World& world) {
  std::size_t vertices = 0, faces = 0;
  for (const Body& body : world.bodies) {
    if (!body.track.at(0)) continue;
    vertices += body.vertices_in_body.size();
    faces += body.triangles.size();
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment frame: map, z up; metres\n";
  const auto& classes = surfaces::allSurfaceClasses();
  for (std::size_t i = 0; i < classes.size(); ++i) out << "comment class " << i << ": " << toString(classes[i]) << "\n";
  out << "element vertex " << vertices << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << faces << "\nproperty list uchar int vertex_indices\nproperty int surface\nproperty uchar class\nend_header\n";
  for (const Body& body : world.bodies) {
    const auto map_from_body = body.track.at(0);
    if (!map_from_body) continue;
    for (const auto& vertex : body.vertices_in_body) {
      const Eigen::Vector3f in_map = (*map_from_body * vertex).cast<float>();
      for (int i = 0; i < 3; ++i) put(out, in_map[i]);
    }
  }
  int first_vertex = 0, first_surface = 1;
  for (const Body& body : world.bodies) {
    if (body.track.at(0)) {
      for (const Triangle& triangle : body.triangles) {
        put(out, std::uint8_t{3});
        for (const int corner : triangle.corners) put(out, std::int32_t{first_vertex + corner});
        put(out, std::int32_t{first_surface + triangle.surface});
        const auto is = body.surfaces[static_cast<std::size_t>(triangle.surface)].is;
        put(out, static_cast<std::uint8_t>(std::find(classes.begin(), classes.end(), is) - classes.begin()));
      }
      first_vertex += static_cast<int>(body.vertices_in_body.size());
    }
    first_surface += static_cast<int>(body.surfaces.size());
  }
}

}  // namespace omnimapper::sim
