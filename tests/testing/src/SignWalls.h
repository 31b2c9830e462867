#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>
#include <omnimapper/sim_world/World.h>

#include <optional>
#include <vector>

namespace omnimapper::testing {

/// A spot on a wall. Seen from the room x points to the right, y up and z out of the wall.
struct WallSpot {
  geometry::Se3 map_from_spot;
};

/// Adds objects that are no signs to the walls of a world (posters and notices, some of them beside signs, switches,
/// sockets, thermostats and grilles) and handles to its closed doors. Returns their spots.
std::vector<WallSpot> addWallObjects(sim::World& world, sim::Random random);

/// A random point in a room from which a camera may look, with free space of 0.3 m around it. None if none was found.
std::optional<Eigen::Vector3d> standpoint(const sim::World& world, const sim::Scene& scene, sim::Random& random);

}  // namespace omnimapper::testing
