#include "GroundGrowth.h"

#include <algorithm>
#include <cmath>

#include "../planes/PlaneMoments.h"

namespace omnimapper::perception::road {

namespace {

using planes::kCell;
using planes::PlaneMoments;

constexpr int kReach = 3;        // cells around one whose ground counts for it
constexpr double kEnough = 300;  // pixels of ground there
constexpr int kSteps = 1000;     // of a distance from the ground, up to the tolerance: sums of whole numbers are exact
constexpr std::int16_t kUnknown = INT16_MAX;

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

  /// Of the windows around the pixels of the next row.
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
      if (row[x] == kUnknown) continue;
      columns_[x].offs += sign * row[x];
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

class Growth {
 public:
  Growth(const planes::InverseDepth& inverse, const Pinhole& camera, const std::vector<std::uint8_t>& seeds)
      : inverse_(inverse),
        camera_(camera),
        seeds_(seeds),
        columns_(inverse.stride / kCell),
        rows_(inverse.rows / kCell),
        moments_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (int y = 0; y < inverse.height; ++y) {
      for (int x = 0; x < inverse.width; ++x) {
        if (seeds[index(x, y)] != 0) addSeed(x, y);
      }
    }
  }

  planes::PixelLabels grow(const std::vector<std::uint8_t>& barred, const GrowthLimits& limits) const {
    planes::PixelLabels labels;
    labels.stride = inverse_.stride;
    labels.rows = inverse_.rows;
    labels.values.resize(static_cast<std::size_t>(labels.stride) * static_cast<std::size_t>(labels.rows), 0);
    const auto offs = offsFromGround(limits.tolerance);
    WindowSums windows(offs, inverse_.width, inverse_.height, limits.radius);
    std::vector<WindowSums::Sum> sums(static_cast<std::size_t>(inverse_.width));
    for (int y = 0; y < inverse_.height; ++y) {
      windows.next(sums);
      std::uint16_t* row = labels.values.data() + static_cast<std::ptrdiff_t>(y) * labels.stride;
      for (int x = 0; x < inverse_.width; ++x) {
        const std::size_t i = index(x, y);
        const bool is_on = std::abs(offs[i]) < kSteps && barred[i] == 0 &&
                           !isAboveOnAverage(sums[static_cast<std::size_t>(x)], limits.correlation_area);
        if (seeds_[i] != 0 || is_on) row[x] = 1;
      }
    }
    return labels;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(inverse_.width) + static_cast<std::size_t>(x);
  }

  void addSeed(int x, int y) {
    PlaneMoments& m = moments_[static_cast<std::size_t>(y / kCell * columns_ + x / kCell)];
    const double u = x - camera_.cx, v = y - camera_.cy, q = static_cast<double>(*inverse_.at(x, y));
    m += {1, u, v, u * u, u * v, v * v, q, u * q, v * q, q * q};
  }

  PlaneMoments momentsAround(int column, int row) const {
    PlaneMoments sum;
    for (int y = std::max(0, row - kReach); y <= std::min(rows_ - 1, row + kReach); ++y) {
      for (int x = std::max(0, column - kReach); x <= std::min(columns_ - 1, column + kReach); ++x)
        sum += moments_[static_cast<std::size_t>(y * columns_ + x)];
    }
    return sum;
  }

  // Of each pixel in steps, clipped; kUnknown where it or the ground is not known.
  std::vector<std::int16_t> offsFromGround(double tolerance) const {
    std::vector<std::int16_t> offs(seeds_.size(), kUnknown);
    const double per_step = kSteps / std::max(tolerance, 1e-9);  // of a tolerance of 0 nothing grows
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const PlaneMoments around = momentsAround(column, row);
        if (around.n < kEnough) continue;
        const planes::ImagePlane ground = around.fit().plane;
        for (int y = row * kCell; y < std::min(inverse_.height, (row + 1) * kCell); ++y) {
          for (int x = column * kCell; x < std::min(inverse_.width, (column + 1) * kCell); ++x) {
            const auto q = static_cast<double>(*inverse_.at(x, y));
            const double off = per_step * (q - ground.at(x - camera_.cx, y - camera_.cy));
            if (q > 0) offs[index(x, y)] = static_cast<std::int16_t>(std::clamp<double>(off, -kSteps, kSteps));
          }
        }
      }
    }
    return offs;
  }

  // Whether pixels are nearer than the ground: errors average out over as many pixels as err apart.
  static bool isAboveOnAverage(const WindowSums::Sum& sum, double correlation_area) {
    const auto total = static_cast<double>(sum.offs), n = static_cast<double>(sum.pixels);
    return total > 0 && total * total >= kSteps * kSteps * n * std::min(n, correlation_area);
  }

  const planes::InverseDepth& inverse_;
  const Pinhole& camera_;
  const std::vector<std::uint8_t>& seeds_;
  int columns_, rows_;
  std::vector<PlaneMoments> moments_;  // of the seeds in each cell
};

}  // namespace

planes::PixelLabels growGround(const planes::InverseDepth& inverse, const Pinhole& camera,
                               const std::vector<std::uint8_t>& seeds, const std::vector<std::uint8_t>& barred,
                               const GrowthLimits& limits) {
  return Growth(inverse, camera, seeds).grow(barred, limits);
}

}  // namespace omnimapper::perception::road
