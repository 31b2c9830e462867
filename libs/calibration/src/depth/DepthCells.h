#pragma once

#include <omnimapper/perception/DepthImage.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace omnimapper::calibration {

/// A square part of a depth image and the plane through its pixels; inverse depth is linear in the image of a plane.
struct DepthCell {
  bool is_flat = false;             ///< else nothing but noise, edges or gaps, and the rest means nothing
  double x = 0, y = 0;              ///< middle of what was measured, from -1 to 1 over the image
  double inverse_depth = 0;         ///< [1/m] mean, hence that of the plane in the middle
  double slope_x = 0, slope_y = 0;  ///< [1/m] for one x or y
};

/// A depth image in cells, row by row.
struct DepthCells {
  static constexpr int kColumns = 40;  ///< of an image; cells are 16 x 16 pixels of 640 x 480
  int columns = 0, rows = 0;
  int width = 0, height = 0;  ///< of the image [px]
  std::vector<DepthCell> cells;

  const DepthCell& at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
};

DepthCells cellsOf(const perception::DepthImage& image);

/// Whether two images of one size show different things, or the same from elsewhere: the median cell has changed by
/// more than noise. Images of a camera at rest say the same, however many there are.
bool areDifferent(const DepthCells& a, const DepthCells& b);

}  // namespace omnimapper::calibration
