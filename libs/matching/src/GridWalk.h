#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>

namespace omnimapper::matching {

/// Calls visit(x, y) for the cells on the way from one place to another, both in cells, in order, until it returns
/// false (Amanatides and Woo 1987). The last cell is left out.
template <class Visit>
void walk(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  int x = static_cast<int>(std::floor(from.x())), y = static_cast<int>(std::floor(from.y()));
  const int last_x = static_cast<int>(std::floor(to.x())), last_y = static_cast<int>(std::floor(to.y()));
  const Eigen::Vector2d way = to - from;
  const int step_x = way.x() > 0 ? 1 : -1, step_y = way.y() > 0 ? 1 : -1;
  const double per_x = std::abs(1 / way.x()), per_y = std::abs(1 / way.y());
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

}  // namespace omnimapper::matching
