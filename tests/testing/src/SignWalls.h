#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>
#include <omnimapper/sim_world/World.h>

#include <optional>
#include <vector>

namespace omnimapper::testing {

/// A spot on a wall: x to the right of who looks at it, y up, z out of the wall.
struct WallSpot {
  geometry::Se3 map_from_spot;
};

/// Hangs what is no sign on the walls of a world, and handles on its closed doors: posters and notices, some of them
/// beside doors where signs hang, switches, sockets, thermostats and grilles. Returns where.
std::vector<WallSpot> hangThings(sim::World& world, sim::Random random);

/// A point of a room from which one can look: free for 0.3 m around.
std::optional<Eigen::Vector3d> standpoint(const sim::World& world, const sim::Scene& scene, sim::Random& random);

}  // namespace omnimapper::testing
