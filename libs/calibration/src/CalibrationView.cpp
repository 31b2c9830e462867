#include "CalibrationView.h"

#include <omnimapper/camera/DepthNoise.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace omnimapper::calibration {

std::optional<LocalPlane> CalibrationView::planeAt(const Eigen::Vector2d& depth_pixel) const {
  constexpr int kRadius = 4, kFewest = 41;  // [px], of 81 pixels
  constexpr double kOneSurface = 0.08;      // largest spread, as a share of the inverse depth
  const int column = static_cast<int>(std::lround(depth_pixel.x())),
            row = static_cast<int>(std::lround(depth_pixel.y()));
  if (column < kRadius || row < kRadius || column + kRadius >= depth_width || row + kRadius >= depth_height)
    return std::nullopt;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0, least = 1e9, most = 0;
  int count = 0;
  for (int v = -kRadius; v <= kRadius; ++v) {
    for (int u = -kRadius; u <= kRadius; ++u) {
      const auto at = static_cast<std::size_t>(row + v) * static_cast<std::size_t>(depth_width) +
                      static_cast<std::size_t>(column + u);
      const auto one = static_cast<double>(inverse_depth[at]);
      if (!(one > 0)) continue;
      const Eigen::Vector3d a(1, u, v);
      normal += a * a.transpose();
      right += one * a;
      squares += one * one;
      least = std::min(least, one);
      most = std::max(most, one);
      ++count;
    }
  }
  if (count < kFewest || most - least > kOneSurface * most) return std::nullopt;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  const double rest = std::max(0.0, squares - plane.dot(right)) / count;
  static const camera::DepthNoise noise;
  constexpr double kNotFlat = 9;  // times the variance of a pixel
  if (!plane.allFinite() || rest > kNotFlat * noise.pixelVariance()) return std::nullopt;
  const double variance = noise.meanVariance() / count + noise.distortionVariance();
  return LocalPlane{Eigen::Vector2d(column, row), plane[0], plane.tail<2>(), std::sqrt(variance)};
}

}  // namespace omnimapper::calibration
