#include "PointIndex.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

namespace {
constexpr float kSide = 0.25F;        // [m] of a cell
constexpr float kCellsPerPoint = 16;  // at most; a larger extent gets larger cells
}  // namespace

PointIndex::PointIndex(const ScanWithNormals& scan) {
  if (scan.empty()) return;
  Eigen::Array2f low = scan.points.front(), high = low;
  for (const auto& p : scan.points) {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  const Eigen::Array2f extent = high - low;
  const float most_cells = kCellsPerPoint * static_cast<float>(scan.size());
  side_ = std::max({kSide, std::sqrt(extent.x() * extent.y() / most_cells), extent.maxCoeff() / most_cells});
  inverse_side_ = 1 / side_;
  min_x_ = low.x();
  min_y_ = low.y();
  columns_ = static_cast<int>(extent.x() * inverse_side_) + 1;
  const int rows = static_cast<int>(extent.y() * inverse_side_) + 1;
  last_column_ = static_cast<float>(columns_ - 1);
  last_row_ = static_cast<float>(rows - 1);

  const std::size_t count = scan.size();
  std::vector<std::uint32_t> cell_of(count);
  first_.assign(static_cast<std::size_t>(columns_) * rows + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const int column = std::min(columns_ - 1, static_cast<int>((scan.points[i].x() - min_x_) * inverse_side_));
    const int row = std::min(rows - 1, static_cast<int>((scan.points[i].y() - min_y_) * inverse_side_));
    cell_of[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++first_[cell_of[i]];
  }
  // Ends of the cells; filling them backwards turns these into their beginnings.
  std::uint32_t sum = 0;
  for (auto& first : first_) first = sum += first;
  for (auto* values : {&xs_, &ys_, &normal_xs_, &normal_ys_}) values->resize(count);
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t place = --first_[cell_of[i]];
    xs_[place] = scan.points[i].x();
    ys_[place] = scan.points[i].y();
    normal_xs_[place] = scan.normals[i].x();
    normal_ys_[place] = scan.normals[i].y();
  }
}

int PointIndex::nearest(float x, float y, float max_distance, int likely) const {
  if (xs_.empty()) return kNone;
  float best = max_distance * max_distance;
  int found = kNone;
  const auto visit = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const float dx = xs_[i] - x, dy = ys_[i] - y;
      const float squared = dx * dx + dy * dy;
      const bool nearer = squared < best;
      best = nearer ? squared : best;
      found = nearer ? static_cast<int>(i) : found;
    }
  };
  if (likely != kNone) visit(likely, likely + 1);
  // Visit all cells that the circle of the smallest distance so far touches, clamped to the border of the grid.
  const float cx = (x - min_x_) * inverse_side_, cy = (y - min_y_) * inverse_side_;
  const float reach = std::sqrt(best) * inverse_side_;
  const auto cell = [](float value, float last) { return static_cast<int>(std::min(std::max(0.0F, value), last)); };
  const int first_column = cell(cx - reach, last_column_), last_column = cell(cx + reach, last_column_);
  const int first_row = cell(cy - reach, last_row_), last_row = cell(cy + reach, last_row_);
  for (int row = first_row; row <= last_row; ++row) {
    const std::size_t base = static_cast<std::size_t>(row) * columns_;
    visit(first_[base + first_column], first_[base + last_column + 1]);
  }
  return found;
}

}  // namespace omnimapper::matching
