#pragma once

#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Random.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// A shape of objects: adds its parts in its usual size, standing on z = 0. The first surface has no part's name.
struct ObjectShape {
  std::string name;
  void (*add)(MeshBuilder&, Random&);
};
/// Sorted by name.
const std::vector<ObjectShape>& shapesOfObjects();

}  // namespace omnimapper::sim
