#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/query/GridMap.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace omnimapper::query {

struct GoalOptions {
  double distance = 1;   ///< [m] before the target
  double radius = 0.25;  ///< [m] of the robot: so far around it all is free
};

/// A pose before a target, facing it. Frame of the map [m] [rad].
struct Goal {
  double x = 0, y = 0, yaw = 0;
  Eigen::Vector2d edge;       ///< the point of the target that it faces
  double distance = 0;        ///< [m] to that
  bool is_connected = false;  ///< to the start, through cells that leave room for the robot
};

/// Where a robot of that size can be in a grid, and which of that it reaches from a start.
class RoomToMove {
 public:
  /// `grid` outlives this. The start is the free place nearest to `start`, if there is one within half a metre.
  RoomToMove(const GridMap& grid, double radius, const Eigen::Vector2d& start);

  /// Whether the robot's disc around the middle of the cell lies on free cells alone.
  bool fits(const Eigen::Vector2i& cell) const;
  bool isStartKnown() const { return is_start_known_; }
  bool isReached(const Eigen::Vector2i& cell) const;
  /// Whether nothing occupied is between two points but for the last `tolerance` [m] before `to`.
  bool isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double tolerance) const;

 private:
  void reach(const Eigen::Vector2i& first);

  const GridMap& grid_;
  std::vector<std::uint16_t> to_blocked_;  // cells to the nearest in the same row that is not free
  std::vector<int> half_widths_;           // [cells] of the disc in its rows, from the middle up
  std::vector<bool> reached_;
  bool is_start_known_ = false;
};

/// The pose that is nearest to `options.distance` before the nearest edge of the target as seen from `start`, straight
/// before it where its free side is known, with the target in sight. Preferred is what is connected to the start.
/// Distances from half to twice the one asked for are tried. None if none of these is free.
std::optional<Goal> goalBefore(const map::Place& target, const Eigen::Vector2d& start, const RoomToMove& room,
                               const GridMap& grid, const GoalOptions& options);

}  // namespace omnimapper::query
