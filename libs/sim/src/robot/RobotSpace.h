#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/World.h>

#include <optional>
#include <vector>

namespace omnimapper::sim {

using Polyline = std::vector<Eigen::Vector2d>;

/// Where a round robot may be on the floor: a grid over the rooms with the distance of each cell to what stands there.
/// One thread at a time: searches share their memory.
class RobotSpace {
 public:
  static constexpr double kCell = 0.05;  ///< [m]

  RobotSpace(const World& world, double radius);

  /// May the robot's middle be here? Never true where it would touch an obstacle.
  bool isFree(const Eigen::Vector2d& point) const;
  /// Is the whole line free?
  bool isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Is there nothing that stands between the two? Distances of the robot do not matter.
  bool isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Distance to the nearest obstacle, of the cell's middle [m]; not above radius + kComfort.
  double clearance(const Eigen::Vector2d& point) const;
  /// Nearest place that is free, and can be reached from `from` if that is given.
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& point,
                                             const std::optional<Eigen::Vector2d>& from = {}) const;
  bool canReach(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Is it in the part of the free floor that is the largest?
  bool isInLargestPart(const Eigen::Vector2d& point) const;
  /// A short and comfortable way, corners only, with both ends. None if there is none.
  std::optional<Polyline> findPath(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// A target among others, as a tour chooses the next.
  struct Target {
    Eigen::Vector2d point;
    double extra = 0;  ///< added to the cost of the way there [m]
  };
  /// The target of the least cost; -1 if none can be reached.
  int nearest(const Eigen::Vector2d& from, const std::vector<Target>& targets) const;

 private:
  static constexpr double kComfort = 0.4;  // [m] beyond the radius: nearer to things costs more
  static constexpr double kStep = 0.02;    // [m] of samples along a line
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
  /// What grow() works on, by cell; kept from search to search.
  struct Scratch {
    std::vector<float> cost;
    std::vector<char> closed;
    std::vector<int> came_from, touched;
  };
  mutable Scratch scratch_;
};

}  // namespace omnimapper::sim
