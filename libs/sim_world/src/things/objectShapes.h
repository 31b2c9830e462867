#pragma once

#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Random.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// A shape of objects. `add` adds its parts in the usual size, standing on z = 0; the first surface has no part name.
struct ObjectShape {
  std::string name;
  void (*add)(MeshBuilder&, Random&);
};
/// Sorted by name.
const std::vector<ObjectShape>& shapesOfObjects();

}  // namespace omnimapper::sim
