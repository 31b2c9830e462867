#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace omnimapper::grid {

struct LikelihoodOptions {
  double cell = 0.05;                ///< [m] side of a cell
  double sigma = 0.08;               ///< [m] standard deviation of the bell around each point of the map
  int levels = 10;                   ///< number of levels, at most kLevels; with 1 only at() and score() can be used
  std::size_t max_cells = 64000000;  ///< a map with more cells is refused; a cell takes about 4 bytes
};

/// For each cell of a map, the likelihood that a point of a scan lies there: 255 in the cells of the map's points, and
/// falling off around them like a Gaussian bell. Each further level has upper bounds of this likelihood over squares
/// with sides of 2^level cells. Immutable, so threads may share it.
class LikelihoodPyramid {
 public:
  static constexpr int kLevels = 10;

  /// `points` in the map's frame [m]; those that are not finite are left out. Throws Error(out_of_range) for a cell or
  /// sigma that is not positive, and for points spread over more than max_cells.
  explicit LikelihoodPyramid(const std::vector<Eigen::Vector2f>& points, const LikelihoodOptions& options = {});

  double cell() const { return cell_; }  ///< [m]
  bool empty() const { return width_ == 0; }
  std::size_t bytes() const;
  /// Corners of the box around the points [m]; both zero without points.
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }
  /// Lower left corner of cell (0, 0) [m].
  const Eigen::Vector2d& origin() const { return origin_; }

  /// Value of the cell (x, y), which may lie anywhere; 0 outside of the map.
  std::uint8_t at(int x, int y) const { return bound(0, x, y); }

  /// Value of the cell that contains a place of the map [m].
  std::uint8_t at(const Eigen::Vector2d& place) const {
    const double x = (place.x() - origin_.x()) / cell_, y = (place.y() - origin_.y()) / cell_;
    return x >= 0 && y >= 0 && x < width_ && y < height_ ? at(static_cast<int>(x), static_cast<int>(y)) : 0;
  }

  /// Upper bound of at() over the cells [x, x + 2^level) by [y, y + 2^level); level < the options' levels.
  std::uint8_t bound(int level, int x, int y) const {
    const Level& grid = levels_[level];
    const unsigned column = static_cast<unsigned>((x + grid.padding) >> grid.shift),
                   row = static_cast<unsigned>((y + grid.padding) >> grid.shift);
    return column < grid.width && row < grid.height ? grid.values[row * grid.width + column] : 0;
  }

  /// Mean likelihood of a scan's finite points, in [0, 1]; 0 if there are none.
  double score(const std::vector<Eigen::Vector2f>& points, const mrpt::math::TPose2D& map_from_scan) const;

 private:
  // Values for every 2^shift-th cell in x and y, the first for cell -padding. A square with sides of 2^level cells may
  // begin at that cell or at any cell before the next value's, so each value is the bound over 2^level + 2^shift - 1
  // cells in x and in y.
  struct Level {
    int shift = 0, padding = 0;
    unsigned width = 0, height = 0;
    std::vector<std::uint8_t> values;
  };
  void drawPoints(const std::vector<Eigen::Vector2f>& points, double sigma);
  void pool(int level);

  double cell_;
  int width_ = 0, height_ = 0;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = low_, origin_ = low_;
  Level levels_[kLevels];
};

}  // namespace omnimapper::grid
