#include "GroundGrowth.h"

#include <algorithm>
#include <cmath>

#include "HeightSteps.h"
#include "LocalGround.h"

namespace omnimapper::perception::road {

namespace {

/// Distances from the ground, summed over square windows that slide down the image.
class WindowSums {
 public:
  WindowSums(const std::vector<std::int16_t>& offs, int width, int height, int radius)
      : offs_(offs), width_(width), height_(height), radius_(radius), columns_(static_cast<std::size_t>(width)) {
    for (int y = 0; y < radius; ++y) add(y, 1);
  }

  struct Sum {
    std::int64_t offs = 0, pixels = 0;
  };

  /// Sums of the windows around the pixels of the next row.
  void next(std::vector<Sum>& sums) {
    add(y_ + radius_, 1);
    Sum sum;
    for (int x = 0; x < std::min(radius_, width_); ++x) change(sum, x, 1);
    for (int x = 0; x < width_; ++x) {
      if (x + radius_ < width_) change(sum, x + radius_, 1);
      sums[static_cast<std::size_t>(x)] = sum;
      if (x >= radius_) change(sum, x - radius_, -1);
    }
    add(y_ - radius_, -1);
    ++y_;
  }

 private:
  void add(int y, int sign) {
    if (y < 0 || y >= height_) return;
    const std::int16_t* row = offs_.data() + static_cast<std::ptrdiff_t>(y) * width_;
    for (std::size_t x = 0; x < columns_.size(); ++x) {
      if (row[x] == LocalGround::kUnknown) continue;
      columns_[x].offs += sign * std::clamp<int>(row[x], -LocalGround::kSteps, LocalGround::kSteps);
      columns_[x].pixels += sign;
    }
  }

  void change(Sum& sum, int x, int sign) const {
    sum.offs += sign * columns_[static_cast<std::size_t>(x)].offs;
    sum.pixels += sign * columns_[static_cast<std::size_t>(x)].pixels;
  }

  const std::vector<std::int16_t>& offs_;
  int width_, height_, radius_, y_ = 0;
  std::vector<Sum> columns_;
};

// Whether the pixels of a window are on average nearer than the ground by more than the tolerance of their mean. Errors
// average out only over the number of independent ones, n / correlation_area.
bool isAboveOnAverage(const WindowSums::Sum& sum, double correlation_area) {
  constexpr double kSteps = LocalGround::kSteps;
  const auto total = static_cast<double>(sum.offs), n = static_cast<double>(sum.pixels);
  return total > 0 && total * total >= kSteps * kSteps * n * std::min(n, correlation_area);
}

}  // namespace

planes::PixelLabels growGround(const planes::InverseDepth& inverse, const camera::Pinhole& camera,
                               const std::vector<std::uint8_t>& seeds, const std::vector<std::uint8_t>& barred,
                               const GrowthLimits& limits) {
  planes::PixelLabels labels;
  labels.stride = inverse.stride;
  labels.rows = inverse.rows;
  labels.values.resize(static_cast<std::size_t>(labels.stride) * static_cast<std::size_t>(labels.rows), 0);
  const LocalGround ground = fitGround(inverse, camera, seeds, limits.tolerance);
  const double mean_variance = std::min(1.0, limits.correlation_area / 16);  // of a block, relative to a pixel's
  const auto steps = findHeightSteps(ground, limits.sigma * std::sqrt(mean_variance), limits.step_sigmas);
  WindowSums windows(ground.offs, inverse.width, inverse.height, limits.radius);
  std::vector<WindowSums::Sum> sums(static_cast<std::size_t>(inverse.width));
  std::size_t i = 0;
  for (int y = 0; y < inverse.height; ++y) {
    windows.next(sums);
    std::uint16_t* row = labels.values.data() + static_cast<std::ptrdiff_t>(y) * labels.stride;
    for (int x = 0; x < inverse.width; ++x, ++i) {
      const bool is_on = std::abs(ground.offs[i]) < LocalGround::kSteps && barred[i] == 0 &&
                         !isAboveOnAverage(sums[static_cast<std::size_t>(x)], limits.correlation_area);
      if ((seeds[i] != 0 || is_on) && steps[i] == 0) row[x] = 1;
    }
  }
  return labels;
}

}  // namespace omnimapper::perception::road
