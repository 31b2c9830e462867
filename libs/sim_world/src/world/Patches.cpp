#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/sim_world/Patches.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace omnimapper::sim {

namespace {

using Eigen::Vector3d;
using Loop3 = std::vector<Vector3d>;

Vector3d areaNormal(const Loop3& walk) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < walk.size(); ++i) sum += (walk[i] - walk[0]).cross(walk[i + 1] - walk[0]) / 2;
  return sum;
}

/// Numbers corners by their position, since a body has a vertex for each face that meets there.
class Places {
 public:
  int numberOf(const Vector3d& point) {
    const auto key = [](double value) { return std::llround(value * 1e6); };  // to the micrometre
    const auto [found, is_new] =
        numbers_.try_emplace({key(point.x()), key(point.y()), key(point.z())}, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(point);
    return found->second;
  }
  const Vector3d& at(int number) const { return points_[static_cast<std::size_t>(number)]; }

 private:
  std::map<std::tuple<long long, long long, long long>, int> numbers_;
  std::vector<Vector3d> points_;
};

struct FlatTriangle {
  std::array<int, 3> corners;  // numbers of places
  geometry::Plane3 plane;
};

bool isOnPlaneOf(const FlatTriangle& a, const FlatTriangle& b) {
  return a.plane.normal.dot(b.plane.normal) > 1 - 1e-8 && std::abs(a.plane.distance - b.plane.distance) < 1e-5;
}

// Groups of triangles that are connected by corners, as lists of their indices.
std::vector<std::vector<std::size_t>> connected(const std::vector<FlatTriangle>& triangles) {
  std::vector<std::size_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto rootOf = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<int, std::vector<std::size_t>> at_corner;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const int corner : triangles[i].corners) {
      for (const std::size_t other : at_corner[corner])
        if (isOnPlaneOf(triangles[i], triangles[other]))
          parent[std::max(rootOf(i), rootOf(other))] = std::min(rootOf(i), rootOf(other));
      at_corner[corner].push_back(i);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < triangles.size(); ++i) groups[rootOf(i)].push_back(i);
  std::vector<std::vector<std::size_t>> result;
  for (auto& group : groups) result.push_back(std::move(group.second));
  return result;
}

// Whether a group is a facet of something round: at an edge it meets another group at a small angle.
bool isFacet(const std::vector<FlatTriangle>& triangles, const std::vector<std::size_t>& group,
             const std::map<std::pair<int, int>, std::vector<std::size_t>>& at_edge) {
  const double least = std::cos(40 * M_PI / 180);
  return std::any_of(group.begin(), group.end(), [&](std::size_t i) {
    const FlatTriangle& triangle = triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto across = at_edge.find({triangle.corners[(k + 1) % 3], triangle.corners[k]});
      if (across == at_edge.end()) continue;
      for (const std::size_t other : across->second) {
        const bool leaves_plane = !isOnPlaneOf(triangle, triangles[other]);
        if (leaves_plane && triangle.plane.normal.dot(triangles[other].plane.normal) > least) return true;
      }
    }
    return false;
  });
}

// The closed walks around a group, along edges that no other triangle of it has in the opposite direction.
std::vector<Loop3> walksAround(const std::vector<FlatTriangle>& triangles, const std::vector<std::size_t>& group,
                               const Places& places) {
  std::map<std::pair<int, int>, int> edges;
  for (const std::size_t i : group) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[i].corners[static_cast<std::size_t>(k)],
                to = triangles[i].corners[static_cast<std::size_t>((k + 1) % 3)];
      const auto back = edges.find({to, from});
      if (back != edges.end()) {
        if (--back->second == 0) edges.erase(back);
      } else {
        ++edges[{from, to}];
      }
    }
  }
  std::vector<Loop3> walks;
  while (!edges.empty()) {
    const int start = edges.begin()->first.first;
    int here = start;
    Loop3 walk;
    do {
      const auto next = edges.lower_bound({here, -1});
      if (next == edges.end() || next->first.first != here) return {};  // no solid has such a face
      walk.push_back(places.at(here));
      here = next->first.second;
      if (--next->second == 0) edges.erase(next);
    } while (here != start);
    walks.push_back(std::move(walk));
  }
  return walks;
}

void addPatchesOf(const Body& body, int body_number, int local, int surface_number, double least,
                  std::vector<Patch>& patches) {
  const Surface& surface = body.surfaces[static_cast<std::size_t>(local)];
  const std::size_t first = patches.size();
  const auto add = [&](const geometry::Plane3& plane, surfaces::FlatPart part, double area) {
    if (area > least) patches.push_back({body_number, surface_number, surface.name, plane, std::move(part)});
  };
  if (surface.face) {
    double area = areaNormal(surface.face->outline_in_body).norm();
    for (const auto& hole : surface.face->holes_in_body) area -= areaNormal(hole).norm();
    add(surface.face->plane_in_body, {surface.face->outline_in_body, surface.face->holes_in_body}, area);
    return;
  }
  Places places;
  std::vector<FlatTriangle> triangles;
  for (const Triangle& triangle : body.triangles) {
    if (triangle.surface != local) continue;
    Loop3 corners;
    for (const int corner : triangle.corners)
      corners.push_back(body.vertices_in_body[static_cast<std::size_t>(corner)]);
    const Vector3d area = areaNormal(corners);
    if (!(area.norm() > 1e-9)) continue;
    FlatTriangle flat{{places.numberOf(corners[0]), places.numberOf(corners[1]), places.numberOf(corners[2])},
                      geometry::Plane3::through(corners[0], area.normalized())};
    triangles.push_back(flat);
  }
  std::map<std::pair<int, int>, std::vector<std::size_t>> at_edge;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      at_edge[{triangles[i].corners[k], triangles[i].corners[(k + 1) % 3]}].push_back(i);
  }
  for (const auto& group : connected(triangles)) {
    if (isFacet(triangles, group, at_edge)) continue;
    const geometry::Plane3& plane = triangles[group.front()].plane;
    // Parts that meet only in a corner have a walk each; the walks of holes go in the opposite direction.
    std::vector<surfaces::FlatPart> parts;
    std::vector<double> areas;
    std::vector<Loop3> holes;
    for (auto& walk : walksAround(triangles, group, places)) {
      const double area = areaNormal(walk).dot(plane.normal);
      if (area > 0) {
        parts.push_back({std::move(walk), {}});
        areas.push_back(area);
      } else {
        holes.push_back(std::move(walk));
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const auto& hole : holes) {
        if (parts.size() > 1 && !geometry::contains(geometry::Polygon3{parts[i].outline}, hole.front())) continue;
        areas[i] -= areaNormal(hole).norm();
        parts[i].holes.push_back(hole);
      }
      add(plane, std::move(parts[i]), areas[i]);
    }
  }
  if (patches.size() - first < 2) return;
  for (std::size_t i = first; i < patches.size(); ++i) patches[i].name += "#" + std::to_string(i - first + 1);
}

}  // namespace

std::vector<Patch> findPatches(const World& world, double least) {
  std::vector<Patch> patches;
  int number = 0;
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    for (std::size_t s = 0; s < world.bodies[b].surfaces.size(); ++s)
      addPatchesOf(world.bodies[b], static_cast<int>(b), static_cast<int>(s), number++, least, patches);
  }
  return patches;
}

}  // namespace omnimapper::sim
