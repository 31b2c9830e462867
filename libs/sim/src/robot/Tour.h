#pragma once

#include <string>
#include <vector>

#include "RobotSpace.h"

namespace omnimapper::sim {

/// A place that a robot is sent to.
struct Stop {
  Eigen::Vector2d in_map;
  std::optional<double> yaw;  ///< to which it turns there [rad]
  std::string name;           ///< as the INI wrote it
};

/// A place well inside of a room: as far from everything as there is, and near its middle.
std::optional<Eigen::Vector2d> goodPlaceIn(const Room& room, const RobotSpace& plan);

/// Places from which all of the rooms' free floor that can be seen is seen from within `reach` [m], ordered by a short
/// way from `start` (or the first room's good place) that finishes a room before it goes on. Rooms that cannot be
/// reached from there have none. `rooms` are numbers of the world's rooms.
std::vector<Stop> planTour(const World& world, const std::vector<int>& rooms, const RobotSpace& plan,
                           const std::optional<Eigen::Vector2d>& start, double reach);

}  // namespace omnimapper::sim
