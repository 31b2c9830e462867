#include <omnimapper/geometry/centroid.h>

#include <cmath>

namespace omnimapper::geometry {

std::optional<Eigen::Vector2d> centroid(const std::vector<Eigen::Vector2d>& polygon) {
  constexpr double kLeast = 1e-9;  // [m^2]
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    sum += cross * (a + b) / 3;
    doubled += cross;
  }
  if (!(std::abs(doubled) > kLeast)) return std::nullopt;
  return polygon[0] + sum / doubled;
}

}  // namespace omnimapper::geometry
