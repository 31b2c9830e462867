#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace omnimapper::grid {

/// Calls visit(x, y) for each cell on the line from `from` to `to`, in order, until visit() returns false (Amanatides
/// and Woo 1987). The coordinates of both points are in cells. The last cell is left out.
template <class Visit>
void walk(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  int x = static_cast<int>(std::floor(from.x())), y = static_cast<int>(std::floor(from.y()));
  const int last_x = static_cast<int>(std::floor(to.x())), last_y = static_cast<int>(std::floor(to.y()));
  const Eigen::Vector2d delta = to - from;
  const int step_x = delta.x() > 0 ? 1 : -1, step_y = delta.y() > 0 ? 1 : -1;
  const double per_x = std::abs(1 / delta.x()), per_y = std::abs(1 / delta.y());
  double next_x = (step_x > 0 ? x + 1 - from.x() : from.x() - x) * per_x,
         next_y = (step_y > 0 ? y + 1 - from.y() : from.y() - y) * per_y;
  for (int steps = std::abs(last_x - x) + std::abs(last_y - y); steps > 0; --steps) {
    if (!visit(x, y)) return;
    if (next_x < next_y || y == last_y) {
      x += step_x;
      next_x += per_x;
    } else {
      y += step_y;
      next_y += per_y;
    }
  }
}

/// Walks only the part of the line that lies in a grid of width x height cells. The ends of the line may be arbitrarily
/// far away, where walk() alone would overflow an int. Visits nothing if the line misses the grid or an end is not
/// finite.
template <class Visit>
void walkInside(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int width, int height, const Visit& visit) {
  const Eigen::Vector2d delta = to - from, size(width, height);
  if (!delta.allFinite()) return;
  double begin = 0, end = 1;  // shares of the line (Liang and Barsky 1984)
  for (int i = 0; i < 2; ++i) {
    if (delta[i] == 0) {
      if (from[i] < 0 || from[i] > size[i]) return;
      continue;
    }
    const double at_low = -from[i] / delta[i], at_high = (size[i] - from[i]) / delta[i];
    begin = std::max(begin, std::min(at_low, at_high));
    end = std::min(end, std::max(at_low, at_high));
  }
  if (begin >= end) return;
  walk(begin > 0 ? Eigen::Vector2d(from + begin * delta) : from, end < 1 ? Eigen::Vector2d(from + end * delta) : to,
       visit);
}

}  // namespace omnimapper::grid
