#pragma once

#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/ObjectMaking.h>
#include <omnimapper/sim_world/Random.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// A shape of objects. `add` adds its parts in the usual size, standing on z = 0; the first surface has no part name.
/// `top` is of the same size.
struct ObjectShape {
  std::string name;
  void (*add)(MeshBuilder&, Random&);
  std::optional<LevelTop> top = {};
};
/// Sorted by name.
const std::vector<ObjectShape>& shapesOfObjects();

}  // namespace omnimapper::sim
