#include "DepthCells.h"

#include <omnimapper/camera/DepthNoise.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace omnimapper::calibration {

namespace {

constexpr double kNearest = 0.2, kFarthest = 12;  // [m]

double inverseDepthAt(const camera::DepthImage& image, std::size_t pixel) {
  constexpr std::uint16_t kNotMeasured = 65535;
  double metres = 0;
  if (image.units() == nullptr) {
    metres = static_cast<double>(image.metres()[pixel]);
  } else if (image.units()[pixel] != kNotMeasured) {
    metres = image.units()[pixel] * image.metresPerUnit();
  }
  return metres >= kNearest && metres <= kFarthest ? 1 / metres : 0;  // 0 for NaN, too
}

// Fits the plane through the pixels of a square whose upper left corner is at this column and row.
DepthCell cellAt(const camera::DepthImage& image, int column, int row, int side) {
  constexpr double kLeastShare = 0.6;  // of the pixels
  constexpr double kNotFlat = 9;       // times the variance of a pixel
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  int count = 0;
  for (int v = row; v < row + side; ++v) {
    for (int u = column; u < column + side; ++u) {
      const double inverse = inverseDepthAt(
          image, static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width()) + static_cast<std::size_t>(u));
      if (inverse == 0) continue;
      const Eigen::Vector3d a(1, u - column, v - row);
      normal += a * a.transpose();
      right += inverse * a;
      squares += inverse * inverse;
      ++count;
    }
  }
  DepthCell cell;
  if (count < kLeastShare * side * side) return cell;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  static const camera::DepthNoise noise;
  const double variance = std::max(0.0, squares - plane.dot(right)) / count;
  cell.is_flat = plane.allFinite() && variance < kNotFlat * noise.pixelVariance();
  cell.inverse_depth = right[0] / count;
  cell.x = (2 * (column + normal(0, 1) / count) + 1) / image.width() - 1;
  cell.y = (2 * (row + normal(0, 2) / count) + 1) / image.height() - 1;
  cell.slope_x = plane[1] * image.width() / 2;
  cell.slope_y = plane[2] * image.height() / 2;
  return cell;
}

}  // namespace

DepthCells cellsOf(const camera::DepthImage& image) {
  constexpr int kLeastSide = 4;
  DepthCells all;
  all.width = image.width();
  all.height = image.height();
  const int side = std::max(kLeastSide, image.width() / DepthCells::kColumns);
  all.columns = image.width() / side;
  all.rows = image.height() / side;
  all.cells.reserve(static_cast<std::size_t>(all.columns) * static_cast<std::size_t>(all.rows));
  for (int row = 0; row < all.rows; ++row)
    for (int column = 0; column < all.columns; ++column)
      all.cells.push_back(cellAt(image, column * side, row * side, side));
  return all;
}

bool areDifferent(const DepthCells& a, const DepthCells& b) {
  constexpr double kChange = 0.006;  // [1/m] several times the noise of a cell
  std::vector<double> changes;
  std::size_t either = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    either += a.cells[i].is_flat || b.cells[i].is_flat;
    if (a.cells[i].is_flat && b.cells[i].is_flat)
      changes.push_back(std::abs(a.cells[i].inverse_depth - b.cells[i].inverse_depth));
  }
  if (2 * changes.size() < either) return true;
  if (changes.empty()) return false;
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return *middle > kChange;
}

}  // namespace omnimapper::calibration
