#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/query/Goal.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace omnimapper::query {

/// A way of a robot through the free cells of a grid.
struct Route {
  double length = 0;                    ///< [m]
  std::vector<Eigen::Vector2d> points;  ///< the middles of its cells, from the start to the end
  /// A room that it passes, and the door through which it enters it: null for the first room, or if no door is known
  /// there.
  struct Passed {
    const building::Room* room;
    const building::Door* door;
  };
  std::vector<Passed> rooms;
};

/// The shortest way from the start of `room` to a point, in steps to the eight neighbours of a cell; none if free cells
/// do not connect both. Without `storey` it passes no rooms. The result points into `storey`.
std::optional<Route> shortestRoute(const RoomToMove& room, const GridMap& grid, const Eigen::Vector2d& to,
                                   const building::Storey* storey);

/// The middle of a free cell of a room at which the robot fits, nearest to the room's centre (thesis 6.2.6); one that
/// is reached from the start, if there is one. None if the robot fits nowhere in the room.
std::optional<Eigen::Vector2d> freeCentre(const building::Room& of, const RoomToMove& room, const GridMap& grid);

}  // namespace omnimapper::query
