#include <omnimapper/base/Error.h>
#include <omnimapper/grid/LikelihoodPyramid.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::grid {

namespace {

constexpr double kBellReach = 3;  // standard deviations that are drawn

void requirePositive(double value, const std::string& name) {
  if (value > 0 && std::isfinite(value)) return;
  throw base::Error(base::ExitCode::out_of_range,
                    name + " of a likelihood grid is " + std::to_string(value) + " m, but must be above 0");
}

// Likelihoods of the cells around a point, side 2 * reach + 1.
struct Bell {
  int reach;
  std::vector<std::uint8_t> values;

  Bell(double cell, double sigma) : reach(static_cast<int>(kBellReach * sigma / cell)) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double squared = (x * x + y * y) * cell * cell / (sigma * sigma);
        values.push_back(squared > kBellReach * kBellReach
                             ? 0
                             : static_cast<std::uint8_t>(std::lround(255 * std::exp(-0.5 * squared))));
      }
    }
  }
};

// The larger of each two values. (`count` is passed by value, so the compiler knows that writing a byte does not change
// it.)
void raise(const std::uint8_t* from, unsigned count, std::uint8_t* to) {
  for (unsigned i = 0; i < count; ++i) to[i] = std::max(to[i], from[i]);
}
void largerOf(const std::uint8_t* first, const std::uint8_t* second, unsigned count, std::uint8_t* to) {
  for (unsigned i = 0; i < count; ++i) to[i] = std::max(first[i], second[i]);
}
// The same for every second value of `first` and both values of `second` from there.
void largerOfEverySecond(const std::uint8_t* first, const std::uint8_t* second, unsigned count, std::uint8_t* to) {
  for (unsigned i = 0; i < count; ++i) {
    to[i] = std::max(first[2 * i], std::max(second[2 * i], second[2 * i + 1]));
  }
}

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const std::vector<Eigen::Vector2f>& points, const LikelihoodOptions& options)
    : cell_(options.cell) {
  requirePositive(options.cell, "The cell");
  requirePositive(options.sigma, "The sigma");
  Eigen::Vector2f low(INFINITY, INFINITY), high = -low;
  for (const auto& point : points) {
    if (!point.allFinite()) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (!(low.x() <= high.x())) return;
  low_ = low.cast<double>();
  high_ = high.cast<double>();
  const Bell bell(cell_, options.sigma);
  origin_ = low_.array() - (bell.reach + 1.5) * cell_;
  const Eigen::Vector2d size = ((high_ - origin_) / cell_).array() + bell.reach + 2;
  if (!(size.prod() <= static_cast<double>(options.max_cells))) {
    throw base::Error(base::ExitCode::out_of_range, "A likelihood grid of " + std::to_string(size.x() * cell_) +
                                                        " m by " + std::to_string(size.y() * cell_) +
                                                        " m has more than " + std::to_string(options.max_cells) +
                                                        " cells: make the cells larger or the map smaller");
  }
  width_ = static_cast<int>(size.x());
  height_ = static_cast<int>(size.y());
  drawPoints(points, options.sigma);
  for (int level = 1; level < std::min(options.levels, kLevels); ++level) pool(level);
}

void LikelihoodPyramid::drawPoints(const std::vector<Eigen::Vector2f>& points, double sigma) {
  const Bell bell(cell_, sigma);
  Level& grid = levels_[0];
  grid.width = width_;
  grid.height = height_;
  grid.values.assign(static_cast<std::size_t>(width_) * height_, 0);
  for (const auto& point : points) {
    if (!point.allFinite()) continue;
    const int x = static_cast<int>((point.x() - origin_.x()) / cell_),
              y = static_cast<int>((point.y() - origin_.y()) / cell_);
    std::uint8_t* const middle = &grid.values[static_cast<std::size_t>(y) * width_ + x];
    if (*middle == 255) continue;  // was drawn before
    const std::uint8_t* value = bell.values.data();
    for (int dy = -bell.reach; dy <= bell.reach; ++dy) {
      std::uint8_t* const row = middle + static_cast<std::ptrdiff_t>(dy) * width_;
      for (int dx = -bell.reach; dx <= bell.reach; ++dx, ++value) row[dx] = std::max(row[dx], *value);
    }
  }
}

// A value of level k + 1 covers what four of level k do. From level 2 on, every second row and column is left out; a
// value must then also cover the stride that it stands for.
void LikelihoodPyramid::pool(int level) {
  const Level& fine = levels_[level - 1];
  Level& coarse = levels_[level];
  coarse.shift = std::max(0, level - 2);
  // In cells of the finer grid: how far the second of the joined squares lies from the first, and the new stride.
  const int step = 1 << (level - 1 - fine.shift), stride = 1 << (coarse.shift - fine.shift);
  const int reach = step + stride - 1;  // offset of the last square joined
  // The first value must begin a whole square before the map.
  coarse.padding = 1 << level;
  coarse.width = static_cast<unsigned>(((width_ + coarse.padding - 1) >> coarse.shift) + 1);
  coarse.height = static_cast<unsigned>(((height_ + coarse.padding - 1) >> coarse.shift) + 1);
  const int offset = (fine.padding - coarse.padding) >> fine.shift;  // of the first coarse value, in the fine grid
  const int fine_width = static_cast<int>(fine.width), fine_height = static_cast<int>(fine.height);
  const auto fineColumn = [&](unsigned column) { return static_cast<int>(column) * stride + offset; };

  // Rows of the fine grid, joined along x.
  std::vector<std::uint8_t> joined(static_cast<std::size_t>(coarse.width) * fine_height);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(coarse.width) * stride + reach);
  for (int y = 0; y < fine_height; ++y) {
    std::fill(row.begin(), row.end(), 0);
    const std::uint8_t* from = &fine.values[static_cast<std::size_t>(y) * fine_width];
    const int copied = std::min<int>(fine_width, static_cast<int>(row.size()) + offset);
    std::copy(from, from + copied, row.begin() - offset);
    std::uint8_t* to = &joined[static_cast<std::size_t>(y) * coarse.width];
    if (stride == 1) {
      largerOf(row.data(), row.data() + step, coarse.width, to);
    } else {
      largerOfEverySecond(row.data(), row.data() + step, coarse.width, to);
    }
  }
  coarse.values.assign(static_cast<std::size_t>(coarse.width) * coarse.height, 0);
  for (unsigned y = 0; y < coarse.height; ++y) {
    std::uint8_t* to = &coarse.values[static_cast<std::size_t>(y) * coarse.width];
    const int first = fineColumn(y);
    for (const int fine_row : {first, first + step, first + reach}) {
      if (fine_row < 0 || fine_row >= fine_height) continue;
      const std::uint8_t* from = &joined[static_cast<std::size_t>(fine_row) * coarse.width];
      raise(from, coarse.width, to);
    }
  }
}

std::size_t LikelihoodPyramid::bytes() const {
  std::size_t total = 0;
  for (const Level& level : levels_) total += level.values.size();
  return total;
}

double LikelihoodPyramid::score(const std::vector<Eigen::Vector2f>& points,
                                const mrpt::math::TPose2D& map_from_scan) const {
  if (empty()) return 0;
  const double c = std::cos(map_from_scan.phi), s = std::sin(map_from_scan.phi);
  std::size_t sum = 0, count = 0;
  for (const auto& point : points) {
    if (!point.allFinite()) continue;
    ++count;
    sum += at({map_from_scan.x + c * point.x() - s * point.y(), map_from_scan.y + s * point.x() + c * point.y()});
  }
  return count == 0 ? 0 : static_cast<double>(sum) / (255.0 * static_cast<double>(count));
}

}  // namespace omnimapper::grid
