#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/sim_world/Texture.h>
#include <omnimapper/sim_world/Track.h>
#include <omnimapper/surfaces/SurfaceClass.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// How a surface looks to cameras and lasers.
struct Material {
  Eigen::Vector3f colour{0.7f, 0.7f, 0.7f};  ///< linear RGB in [0, 1]; multiplied with the texture
  std::shared_ptr<const Texture> texture;    ///< none: one colour
  /// Part of infrared light (0.83 to 0.95 um) that is scattered back, in [0, 1]: 0.8 white paint, 0.05 black cloth.
  float infrared = 0.6f;
  /// Part of the light that goes straight through, in [0, 1]: 0 for all but glass.
  float transmission = 0.0f;
};

enum class SurfaceKind {
  floor,
  ceiling,
  wall,
  door,
  window,
  table,
  counter,
  shelf,
  chair,
  object,
  sign,
  poster,
  marker,
  person,
  road,
  kerb,
  clutter
};
std::string toString(SurfaceKind kind);

/// The class of most surfaces of that kind.
surfaces::SurfaceClass usualClass(SurfaceKind kind);

/// The true face of a planar surface, in the frame of the body; holes are outlines inside it.
struct PlanarFace {
  geometry::Plane3 plane_in_body;
  std::vector<Eigen::Vector3d> outline_in_body;  ///< counter-clockwise seen from the side the normal points to [m]
  std::vector<std::vector<Eigen::Vector3d>> holes_in_body;
};

/// A part of a body that has one label: a wall of a room, the top of a table, the whole of a cup.
struct Surface {
  std::string name;  ///< unique in the world: "kitchen/wall_2", "table_1/top"
  SurfaceKind kind = SurfaceKind::clutter;
  Material material;
  std::optional<PlanarFace> face;  ///< none: the surface is not flat
  /// The class that people would give the surface; the sides of furniture may have another class than its top.
  surfaces::SurfaceClass is = surfaces::SurfaceClass::surface;
};

struct Triangle {
  /// Indices into Body::vertices_in_body, counter-clockwise seen from outside; both sides are visible.
  std::array<int, 3> corners;
  int surface = 0;  ///< index into Body::surfaces
  /// Texture coordinates of each corner, as Texture::at() takes them.
  std::array<Eigen::Vector2f, 3> texture_at{Eigen::Vector2f(0, 0), Eigen::Vector2f(0, 0), Eigen::Vector2f(0, 0)};
};

/// A rigid body with its surfaces.
struct Body {
  std::string name;                               ///< unique in the world
  std::vector<Eigen::Vector3d> vertices_in_body;  ///< [m]
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;
  Track track{geometry::Se3{}};
};

}  // namespace omnimapper::sim
