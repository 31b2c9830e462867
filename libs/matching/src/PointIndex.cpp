#include "PointIndex.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

namespace {
constexpr float kSide = 0.25F;        // [m] of a cell
constexpr float kMaxCells = 1 << 20;  // a larger extent gets larger cells
}  // namespace

PointIndex::PointIndex(PlanarScan scan) {
  if (scan.empty()) return;
  Eigen::Vector2f low = scan.points.front(), high = low;
  for (const auto& p : scan.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2f extent = high - low;
  side_ = std::max(kSide, std::sqrt(extent.x() * extent.y() / kMaxCells));
  side_ = std::max(side_, extent.maxCoeff() / kMaxCells);
  min_x_ = low.x();
  min_y_ = low.y();
  columns_ = static_cast<int>(extent.x() / side_) + 1;
  rows_ = static_cast<int>(extent.y() / side_) + 1;

  std::vector<std::uint32_t> cell_of(scan.size());
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const int column = std::min(columns_ - 1, static_cast<int>((scan.points[i].x() - min_x_) / side_));
    const int row = std::min(rows_ - 1, static_cast<int>((scan.points[i].y() - min_y_) / side_));
    cell_of[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++first_[cell_of[i] + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  points_.resize(scan.size());
  normals_.resize(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::uint32_t place = next[cell_of[i]]++;
    points_[place] = scan.points[i];
    normals_[place] = scan.normals[i];
  }
}

// Rings of cells around the point's own, until no nearer point can come.
int PointIndex::nearest(float x, float y, float max_distance) const {
  if (points_.empty()) return kNone;
  const float cx = (x - min_x_) / side_, cy = (y - min_y_) / side_;
  const float reach = max_distance / side_;
  if (!(cx > -reach && cy > -reach && cx < static_cast<float>(columns_) + reach &&
        cy < static_cast<float>(rows_) + reach)) {
    return kNone;
  }
  const int column = static_cast<int>(std::floor(cx)), row = static_cast<int>(std::floor(cy));
  const float in_x = cx - static_cast<float>(column), in_y = cy - static_cast<float>(row);
  const float to_border = std::min(std::min(in_x, 1 - in_x), std::min(in_y, 1 - in_y)) * side_;
  float best = max_distance * max_distance;
  int found = kNone;
  const auto visit = [&](int r, int first_column, int last_column) {
    if (r < 0 || r >= rows_) return;
    first_column = std::max(first_column, 0);
    last_column = std::min(last_column, columns_ - 1);
    if (first_column > last_column) return;
    const std::size_t base = static_cast<std::size_t>(r) * columns_;
    for (std::uint32_t i = first_[base + first_column]; i < first_[base + last_column + 1]; ++i) {
      const float dx = points_[i].x() - x, dy = points_[i].y() - y;
      const float squared = dx * dx + dy * dy;
      if (squared >= best) continue;
      best = squared;
      found = static_cast<int>(i);
    }
  };
  for (int ring = 0;; ++ring) {
    const float nearest_there = ring == 0 ? 0 : to_border + static_cast<float>(ring - 1) * side_;
    if (nearest_there * nearest_there >= best) return found;
    if (ring == 0) {
      visit(row, column, column);
      continue;
    }
    visit(row - ring, column - ring, column + ring);
    visit(row + ring, column - ring, column + ring);
    for (int r = row - ring + 1; r < row + ring; ++r) {
      visit(r, column - ring, column - ring);
      visit(r, column + ring, column + ring);
    }
  }
}

}  // namespace omnimapper::matching
