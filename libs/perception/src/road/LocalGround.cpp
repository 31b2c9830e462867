#include "LocalGround.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::perception::road {

namespace {

using planes::kCell;
using planes::PlaneMoments;

// Distance [cells] up to which ground is used for the plane of a cell: a plane fitted across a step is tilted, but less
// so over a wider area.
constexpr int kReach = 6;
constexpr double kEnough = 300;  // ground pixels for a plane

class Fitting {
 public:
  Fitting(const planes::InverseDepth& inverse, const camera::Pinhole& camera, const std::vector<std::uint8_t>& seeds)
      : inverse_(inverse),
        camera_(camera),
        columns_(inverse.stride / kCell),
        rows_(inverse.rows / kCell),
        moments_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (int y = 0; y < inverse.height; ++y) {
      for (int x = 0; x < inverse.width; ++x) {
        if (seeds[index(x, y)] != 0) addSeed(x, y);
      }
    }
  }

  LocalGround fit(double reach) const {
    LocalGround ground;
    ground.width = inverse_.width;
    ground.height = inverse_.height;
    ground.columns = columns_;
    ground.rows = rows_;
    ground.camera = camera_;
    ground.planes.resize(moments_.size());
    ground.offs.resize(static_cast<std::size_t>(inverse_.width) * static_cast<std::size_t>(inverse_.height),
                       LocalGround::kUnknown);
    ground.step = std::max(reach, 1e-9) / LocalGround::kSteps;  // with a reach of 0 no pixel is near
    const auto around = momentsAround();
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const PlaneMoments& moments = around[cell(column, row)];
        if (moments.n < kEnough) continue;
        ground.planes[cell(column, row)] = moments.fit().plane;
        measure(column, row, *ground.planeAt(column * kCell, row * kCell), ground);
      }
    }
    return ground;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(inverse_.width) + static_cast<std::size_t>(x);
  }

  std::size_t cell(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }

  void addSeed(int x, int y) {
    PlaneMoments& m = moments_[cell(x / kCell, y / kCell)];
    const double u = x - camera_.cx, v = y - camera_.cy, q = static_cast<double>(*inverse_.at(x, y));
    m += {1, u, v, u * u, u * v, v * v, q, u * q, v * q, q * q};
  }

  // Sums of the moments of the cells around each cell.
  std::vector<PlaneMoments> momentsAround() const {
    std::vector<PlaneMoments> of_rows(moments_.size()), around(moments_.size());
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        PlaneMoments& sum = of_rows[cell(x, y)];
        for (int i = std::max(0, x - kReach); i <= std::min(columns_ - 1, x + kReach); ++i) sum += moments_[cell(i, y)];
      }
    }
    for (int y = 0; y < rows_; ++y) {
      for (int i = std::max(0, y - kReach); i <= std::min(rows_ - 1, y + kReach); ++i) {
        for (int x = 0; x < columns_; ++x) around[cell(x, y)] += of_rows[cell(x, i)];
      }
    }
    return around;
  }

  void measure(int column, int row, const planes::ImagePlane& plane, LocalGround& ground) const {
    constexpr double kMost = LocalGround::kFarthest;
    for (int y = row * kCell; y < std::min(inverse_.height, (row + 1) * kCell); ++y) {
      for (int x = column * kCell; x < std::min(inverse_.width, (column + 1) * kCell); ++x) {
        const auto q = static_cast<double>(*inverse_.at(x, y));
        const double off = (q - plane.at(x - camera_.cx, y - camera_.cy)) / ground.step;
        if (q > 0) ground.offs[index(x, y)] = static_cast<std::int16_t>(std::clamp(off, -kMost, kMost));
      }
    }
  }

  const planes::InverseDepth& inverse_;
  const camera::Pinhole& camera_;
  int columns_, rows_;
  std::vector<PlaneMoments> moments_;  // of the seeds in each cell
};

}  // namespace

double LocalGround::between(double x, double y) const {
  const double to_x = std::clamp((x + 0.5) / kCell - 0.5, 0., columns - 1.);
  const double to_y = std::clamp((y + 0.5) / kCell - 0.5, 0., rows - 1.);
  double sum = 0, weights = 0;
  for (int row = static_cast<int>(to_y); row < std::min(rows, static_cast<int>(to_y) + 2); ++row) {
    for (int column = static_cast<int>(to_x); column < std::min(columns, static_cast<int>(to_x) + 2); ++column) {
      const auto& plane = planes[static_cast<std::size_t>(row * columns + column)];
      const double weight = plane ? (1 - std::abs(to_x - column)) * (1 - std::abs(to_y - row)) : 0;
      if (!(weight > 0)) continue;
      sum += weight * plane->at(x - camera.cx, y - camera.cy);
      weights += weight;
    }
  }
  return sum / weights;
}

LocalGround fitGround(const planes::InverseDepth& inverse, const camera::Pinhole& camera,
                      const std::vector<std::uint8_t>& seeds, double reach) {
  return Fitting(inverse, camera, seeds).fit(reach);
}

}  // namespace omnimapper::perception::road
