#include "kinect/KinectLens.h"

#include <cmath>

namespace omnimapper::drivers {

NormalizedPoint distort(const mrpt::img::TCamera& camera, NormalizedPoint direction) {
  const double* lens = camera.dist.data();
  const double k1 = lens[0], k2 = lens[1], p1 = lens[2], p2 = lens[3], k3 = lens[4];
  const double x = direction.x, y = direction.y, r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

// Iterates to a fixed point, which exists for the weak lenses of these cameras except beyond their rims.
std::optional<NormalizedPoint> undistort(const mrpt::img::TCamera& camera, NormalizedPoint image) {
  constexpr int kSteps = 100;
  constexpr double kEnough = 1e-7, kFarthest = 4;
  NormalizedPoint direction = image;
  for (int step = 0; step < kSteps; ++step) {
    const NormalizedPoint there = distort(camera, direction);
    const double x = image.x - there.x, y = image.y - there.y;
    if (std::abs(x) + std::abs(y) < kEnough) return direction;
    direction = {direction.x + x, direction.y + y};
    if (!(std::abs(direction.x) + std::abs(direction.y) < kFarthest)) break;
  }
  return std::nullopt;
}

}  // namespace omnimapper::drivers
