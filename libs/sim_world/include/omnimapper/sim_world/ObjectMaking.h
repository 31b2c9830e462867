#pragma once

#include <omnimapper/sim_world/World.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The shapes makeObject() knows, sorted: "ball", "book", "bottle", ...
const std::vector<std::string>& objectShapes();

struct ObjectSpec {
  std::string name;   ///< of its body
  std::string shape;  ///< one of objectShapes()
  /// Determines colours, textures and, if no size is given, the size, up to 15 % from the usual one.
  std::uint64_t seed = 0;
  /// Extents along x, y and z of the whole object with its handle [m].
  std::optional<Eigen::Vector3d> size;
  geometry::Se3 map_from_object;
  bool moveable = false;
};

/// A level area of an object on which others can stand.
struct LevelTop {
  std::vector<Eigen::Vector2d> outline_in_body;  ///< convex, counter-clockwise [m]
  double z = 0;                                  ///< height above the object's lowest point [m]
};

struct MadeObject {
  Body body;
  Object object;
  std::optional<LevelTop> top;  ///< none: nothing can stand on it
};

/// The shapes that have a level top, sorted: "book", "box", ...
const std::vector<std::string>& carryingShapes();

/// An object that stands on z = 0 of its body. Its axis, or its middle if it has no axis, is on the z axis of the body;
/// its front, if it has one, faces -y. Surfaces: "<name>", and "<name>/<part>" for parts of other colours; none has a
/// PlanarFace. Each part is closed; parts may overlap. Throws base::Error(out_of_range) for an unknown shape, with the
/// list of known ones, and for a size that is not positive.
MadeObject makeObject(const ObjectSpec& spec);

/// Extents of a body along its own axes [m].
Eigen::Vector3d extentsOf(const Body& body);

}  // namespace omnimapper::sim
