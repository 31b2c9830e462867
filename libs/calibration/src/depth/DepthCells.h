#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace omnimapper::calibration {

/// A square part of a depth image and the plane through its pixels; inverse depth is linear in the image of a plane.
struct DepthCell {
  bool is_flat = false;             ///< false: it has only noise, edges or gaps, and the other members are invalid
  double x = 0, y = 0;              ///< mean position of the measured pixels, from -1 to 1 over the image
  double inverse_depth = 0;         ///< [1/m] mean, which is that of the plane at this position
  double slope_x = 0, slope_y = 0;  ///< [1/m] change of the inverse depth for one x or y
};

/// A depth image in cells, row by row.
struct DepthCells {
  static constexpr int kColumns = 40;  ///< number of cells across an image; in 640 x 480 pixels a cell has 16 x 16
  int columns = 0, rows = 0;
  int width = 0, height = 0;  ///< of the image [px]
  std::vector<DepthCell> cells;

  const DepthCell& at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
};

DepthCells cellsOf(const camera::DepthImage& image);

/// Whether two images of one size show different scenes, or the same scene from different poses: the median cell has
/// changed by more than noise. Many images of a camera at rest have no more information than one.
bool areDifferent(const DepthCells& a, const DepthCells& b);

}  // namespace omnimapper::calibration
