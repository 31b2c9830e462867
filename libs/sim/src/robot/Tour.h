#pragma once

#include <string>
#include <vector>

#include "RobotSpace.h"

namespace omnimapper::sim {

/// A place that a robot is sent to.
struct Stop {
  Eigen::Vector2d in_map;
  std::optional<double> yaw;  ///< heading to which the robot turns there [rad]
  std::string name;           ///< as in the INI, or the room's name
};

/// A place well inside a room: far from obstacles and near the room's middle.
std::optional<Eigen::Vector2d> goodPlaceIn(const Room& room, const RobotSpace& plan);

/// Places from which all floor of the rooms that can be seen is seen from within `reach` [m]. They are in the order of
/// a short path from `start` (or the first room's good place) that finishes a room before it goes on. Rooms that cannot
/// be reached from there have no places. `rooms` are indices into world.rooms.
std::vector<Stop> planTour(const World& world, const std::vector<int>& rooms, const RobotSpace& plan,
                           const std::optional<Eigen::Vector2d>& start, double reach);

}  // namespace omnimapper::sim
