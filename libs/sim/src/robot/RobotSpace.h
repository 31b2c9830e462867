#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/World.h>

#include <optional>
#include <vector>

namespace omnimapper::sim {

using Polyline = std::vector<Eigen::Vector2d>;

/// The places where a round robot may be on the floor: a grid over the rooms with the distance of each cell to the
/// nearest obstacle. Only one thread may use it at a time, because searches share their memory.
class RobotSpace {
 public:
  static constexpr double kCell = 0.05;  ///< [m]

  RobotSpace(const World& world, double radius);

  /// Whether the robot's centre may be here. Never true where the robot would touch an obstacle.
  bool isFree(const Eigen::Vector2d& point) const;
  /// Whether the whole line is free.
  bool isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Whether no obstacle stands between the two points. The robot's radius does not matter.
  bool isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Distance from the centre of the point's cell to the nearest obstacle, at most radius + kComfort [m]; negative
  /// where the point is not on the plan.
  double clearance(const Eigen::Vector2d& point) const;
  /// Nearest free place that can be reached from `from`, or, without `from`, that is in the largest connected part.
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& point,
                                             const std::optional<Eigen::Vector2d>& from = {}) const;
  bool canReach(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Whether the point is in the largest connected part of the free floor.
  bool isInLargestPart(const Eigen::Vector2d& point) const;
  /// The corners, with both ends, of a short path that keeps a comfortable distance to obstacles. None if there is no
  /// path.
  std::optional<Polyline> findPath(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// One of the targets among which a tour chooses the next.
  struct Target {
    Eigen::Vector2d point;
    double extra = 0;  ///< added to the cost of the path there [m]
  };
  /// Index of the target with the least cost; -1 if none can be reached.
  int nearest(const Eigen::Vector2d& from, const std::vector<Target>& targets) const;

 private:
  static constexpr double kComfort = 0.4;  // [m] beyond the radius: a path nearer to obstacles costs more
  static constexpr double kStep = 0.02;    // [m] between samples along a line
  static constexpr double kHalfDiagonal = 0.70710678118654752 * kCell;  // of a cell [m]

  int cellOf(const Eigen::Vector2d& point) const;  // -1: outside
  Eigen::Vector2d middleOf(int cell) const;
  bool isFreeCell(int cell) const { return cell >= 0 && clearance_[cell] >= needed_; }
  double costOf(int cell) const;
  double costOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;  // infinity: not free
  void measureClearance(const World& world);
  void markRooms(const World& world);
  void labelParts();
  template <class Visit>
  void forEachCellNear(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double margin,
                       const Visit& visit) const;
  template <class Estimate, class Arrived>
  void grow(int from, const Estimate& estimate, const Arrived& arrived) const;
  Polyline shortened(const Polyline& path) const;

  double radius_, needed_;
  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> clearance_;  // [m]; negative: not on the plan
  std::vector<char> is_in_room_;
  std::vector<int> part_;  // connected parts of the free cells; -1: not free
  int largest_part_ = -1;
  /// Working memory of grow(), by cell; it is kept from search to search.
  struct Scratch {
    std::vector<float> cost;
    std::vector<char> closed;
    std::vector<int> came_from, touched;
  };
  mutable Scratch scratch_;
};

}  // namespace omnimapper::sim
