#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::testing {

/// Upright walls on a floor [m].
struct FloorPlan {
  struct Wall {
    Eigen::Vector2d from, to;
  };
  std::vector<Wall> walls;

  /// Adds walls from corner to corner, and from the last corner to the first.
  void addPolygon(const std::vector<Eigen::Vector2d>& corners);
  /// Distance from `origin` along the unit `direction` to the first wall; infinity if there is none.
  double distanceToWall(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) const;

  /// A corridor that is 3 m wide around a block, 20 m x 12 m in all, with niches, rooms and pillars, so that no two
  /// parts are alike. Its centre line passes through the origin along x and continues counter-clockwise.
  static FloorPlan ring();
  /// One room of 8 m x 6 m with a pillar; the origin is 1.5 m from the middle of a long wall.
  static FloorPlan box();
};

}  // namespace omnimapper::testing
