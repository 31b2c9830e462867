#include "KinectLens.h"

namespace omnimapper::live {

Eigen::Vector2d throughLens(const mrpt::img::TCamera& camera, const Eigen::Vector2d& direction) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = camera.dist;
  const double x = direction.x(), y = direction.y(), r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

// By a fixed point, which the weak lenses of these cameras have everywhere but beyond their rims.
std::optional<Eigen::Vector2d> beforeLens(const mrpt::img::TCamera& camera, const Eigen::Vector2d& image) {
  constexpr int kSteps = 100;
  constexpr double kEnough = 1e-7, kFarthest = 4;
  Eigen::Vector2d direction = image;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector2d miss = image - throughLens(camera, direction);
    if (miss.norm() < kEnough) return direction;
    direction += miss;
    if (!(direction.norm() < kFarthest)) break;
  }
  return std::nullopt;
}

}  // namespace omnimapper::live
