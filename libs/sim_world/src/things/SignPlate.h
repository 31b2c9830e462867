#pragma once

#include <omnimapper/sim_world/Body.h>

#include <memory>
#include <string>

namespace omnimapper::sim {

/// A plate that hangs flat on a wall. Frame: x to the reader's right, y up, z to the reader; origin in the middle of
/// the front, the back at z = -thickness.
struct SignPlate {
  std::string name;
  SurfaceKind kind;
  std::shared_ptr<const Texture> picture;
  double width, height, thickness;  // [m]
  Eigen::Vector3f edge_colour;
  geometry::Se3 map_from_plate;
};

/// Surface "<name>" is the front, a planar face; "<name>/edge" is the rest.
Body makePlate(const SignPlate& plate);

}  // namespace omnimapper::sim
