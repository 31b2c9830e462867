#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Things are carried elsewhere at once; nobody is to see it. A sentence for each time before `duration` [s] at which
/// the robot is in a room that something is carried from or to, with when it is not.
std::vector<std::string> seenMoves(const World& world, const Track& map_from_base, double duration);

}  // namespace omnimapper::sim
