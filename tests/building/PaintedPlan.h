#pragma once

#include <omnimapper/grid/GridMap.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::building {

/// A grid that is painted with rectangles in the frame of a plan [m]. The plan may be turned in its grid; the frame of
/// the map is that of the plan.
class PaintedPlan {
 public:
  PaintedPlan(double width, double height, double resolution = 0.05, double turn = 0) {
    const double side = turn == 0 ? 0 : std::hypot(width, height) + 1;
    grid_.resolution = resolution;
    grid_.columns = static_cast<int>(std::lround(std::max(side, width + 1) / resolution));
    grid_.rows = static_cast<int>(std::lround(std::max(side, height + 1) / resolution));
    grid_.cells.assign(static_cast<std::size_t>(grid_.columns) * grid_.rows, grid::GridCell::unknown);
    const geometry::Se2 plan_from_turned{width / 2, height / 2, -turn};
    grid_.map_from_grid =
        plan_from_turned * geometry::Se2{-grid_.columns * resolution / 2, -grid_.rows * resolution / 2, 0};
  }

  PaintedPlan& paint(grid::GridCell cell, double min_x, double min_y, double max_x, double max_y) {
    for (int y = 0; y < grid_.rows; ++y) {
      for (int x = 0; x < grid_.columns; ++x) {
        const Eigen::Vector2d at = grid_.middleOf({x, y});
        if (at.x() >= min_x && at.x() < max_x && at.y() >= min_y && at.y() < max_y)
          grid_.cells[grid_.indexOf({x, y})] = cell;
      }
    }
    return *this;
  }
  /// Free space with a wall of 0.1 m around it, which lies outside.
  PaintedPlan& room(double min_x, double min_y, double max_x, double max_y) {
    constexpr double kWall = 0.1;
    paint(grid::GridCell::occupied, min_x - kWall, min_y - kWall, max_x + kWall, max_y + kWall);
    return free(min_x, min_y, max_x, max_y);
  }
  PaintedPlan& free(double min_x, double min_y, double max_x, double max_y) {
    return paint(grid::GridCell::free, min_x, min_y, max_x, max_y);
  }
  PaintedPlan& thing(double min_x, double min_y, double max_x, double max_y) {
    return paint(grid::GridCell::occupied, min_x, min_y, max_x, max_y);
  }

  const grid::GridMap& grid() const { return grid_; }
  grid::GridMap& grid() { return grid_; }

 private:
  grid::GridMap grid_;
};

/// A room of 4 m x 3 m and one of 3 m x 3 m, with a wall of 0.1 m and a door of 0.9 m between them, at x = 4 m and y
/// from 1 m to 1.9 m.
inline PaintedPlan twoRooms(double resolution = 0.05, double turn = 0) {
  PaintedPlan plan(7.1, 3, resolution, turn);
  plan.room(0, 0, 4, 3).room(4.1, 0, 7.1, 3).free(4, 1, 4.1, 1.9);
  return plan;
}

/// A corridor of 12 m x 2 m with three rooms of 3.9 m x 4 m above it, each with a door of 0.9 m.
inline PaintedPlan corridorWithRooms(double resolution = 0.05, double turn = 0) {
  PaintedPlan plan(12, 6.1, resolution, turn);
  plan.room(0, 0, 12, 2);
  for (const double left : {0.0, 4.05, 8.1}) plan.room(left, 2.1, left + 3.9, 6.1);
  for (const double left : {1.0, 5.0, 9.0}) plan.free(left, 2, left + 0.9, 2.1);
  return plan;
}

}  // namespace omnimapper::building
