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

/// What a surface looks like to eye and laser.
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

/// A face of a planar surface as the truth tells it, in the frame of the body: holes are outlines inside.
struct PlanarFace {
  geometry::Plane3 plane_in_body;
  std::vector<Eigen::Vector3d> outline_in_body;  ///< counter-clockwise seen from the side the normal points to [m]
  std::vector<std::vector<Eigen::Vector3d>> holes_in_body;
};

/// What carries one label: a wall of a room, the top of a table, the whole of a cup.
struct Surface {
  std::string name;  ///< unique in the world: "kitchen/wall_2", "table_1/top"
  SurfaceKind kind = SurfaceKind::clutter;
  Material material;
  std::optional<PlanarFace> face;  ///< none: it is not flat
  /// What a person would call it; of a furniture's kind the sides may be of another class than the top.
  surfaces::SurfaceClass is = surfaces::SurfaceClass::surface;
};

struct Triangle {
  std::array<int, 3> corners;  ///< into Body::vertices_in_body; counter-clockwise from outside. Both sides are seen.
  int surface = 0;             ///< into Body::surfaces
  std::array<Eigen::Vector2f, 3> texture_at{Eigen::Vector2f(0, 0), Eigen::Vector2f(0, 0),
                                            Eigen::Vector2f(0, 0)};  ///< of each corner, as Texture::at()
};

/// A rigid thing with its surfaces.
struct Body {
  std::string name;                               ///< unique in the world
  std::vector<Eigen::Vector3d> vertices_in_body;  ///< [m]
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;
  Track track{geometry::Se3{}};
};

}  // namespace omnimapper::sim
