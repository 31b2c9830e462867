#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/query/MapGrid.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace omnimapper::query {

struct GoalOptions {
  double distance = 1;   ///< [m] distance from the target
  double radius = 0.25;  ///< [m] radius of the robot, within which all cells must be free
};

/// A pose in front of a target, facing it. Frame of the map [m] [rad].
struct Goal {
  double x = 0, y = 0, yaw = 0;
  Eigen::Vector2d edge;       ///< the point of the target that it faces
  double distance = 0;        ///< [m] distance to `edge`
  bool is_connected = false;  ///< connected to the start by cells that leave room for the robot
};

/// The cells of a grid where a robot of that size fits, and those that it reaches from a start.
class RoomToMove {
 public:
  /// `grid` must outlive this object. The start is the free place nearest to `start`, if there is one within half a
  /// metre.
  RoomToMove(const GridMap& grid, double radius, const Eigen::Vector2d& start);

  /// Whether the robot's disc around the centre of the cell covers only free cells.
  bool fits(const Eigen::Vector2i& cell) const;
  bool isStartKnown() const { return start_.has_value(); }
  /// The cell at which the robot starts.
  const std::optional<Eigen::Vector2i>& start() const { return start_; }
  bool isReached(const Eigen::Vector2i& cell) const;
  /// Whether the line between two points crosses no occupied cell, except in the last `tolerance` [m] before `to`.
  bool isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double tolerance) const;

 private:
  void reach(const Eigen::Vector2i& first);

  const GridMap& grid_;
  std::vector<std::uint16_t> to_blocked_;  // number of cells to the nearest one in the same row that is not free
  std::vector<int> half_widths_;           // [cells] half widths of the disc in its rows, from the centre up
  std::vector<bool> reached_;
  std::optional<Eigen::Vector2i> start_;
};

/// A free pose that faces the target, with a line of sight to the target. The best pose is at `options.distance` from
/// the target's edge nearest to `start`, straight in front of the target's free side if this side is known. If that
/// pose is not free, other edges, directions, and distances from half to twice the requested distance are tried, and
/// the pose that differs least is taken. Poses connected to the start are preferred. None if no such pose is free.
std::optional<Goal> goalBefore(const map::Place& target, const Eigen::Vector2d& start, const RoomToMove& room,
                               const GridMap& grid, const GoalOptions& options);

}  // namespace omnimapper::query
