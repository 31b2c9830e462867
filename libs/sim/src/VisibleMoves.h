#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Warnings about objects that jump before the robot's eyes, because they are carried elsewhere instantly. There is a
/// sentence for each time before `duration` [s] at which the robot is in a room that an object is carried from or to,
/// with the nearest time at which it is in a room where none of them is.
std::vector<std::string> visibleMoves(const World& world, const Track& map_from_base, double duration);

}  // namespace omnimapper::sim
