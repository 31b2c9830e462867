#include "FlatPatches.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace omnimapper::calibration {

namespace {

using camera::DepthDistortion;

constexpr double kSteeper = 0.006;  // [1/m] largest difference of the slopes of cell and plane, across a cell

/// Sums from which a plane is fitted.
struct PlaneSums {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();

  void add(double x, double y, double inverse_depth, double weight = 1) {
    const Eigen::Vector3d a(1, x, y);
    normal += weight * a * a.transpose();
    right += weight * inverse_depth * a;
  }
  Eigen::Vector3d plane() const { return normal.ldlt().solve(right); }
};

double valueOf(const Eigen::Vector3d& plane, double x, double y) {
  return plane[0] + plane[1] * x + plane[2] * y;
}

/// Grows planes over the cells of one image; each cell is in at most one plane.
class Growth {
 public:
  Growth(const DepthCells& image, const DepthDistortion& known, double bound)
      : image_(image), bound_(bound), corrected_(image.cells.size()), is_taken_(image.cells.size(), false) {
    for (std::size_t i = 0; i < image.cells.size(); ++i) {
      const auto& cell = image.cells[i];
      corrected_[i] = cell.inverse_depth + known.at(cell.x, cell.y);
    }
  }

  std::vector<std::vector<std::size_t>> grow() {
    const std::size_t fewest = image_.cells.size() / 25;
    std::vector<std::vector<std::size_t>> all;
    for (const auto& [rms, seed] : seeds()) {
      if (is_taken_[seed]) continue;
      auto patch = growFrom(seed);
      is_taken_[seed] = true;  // even if nothing grows from it
      if (patch.size() < std::max<std::size_t>(fewest, 9)) continue;
      for (const auto i : patch) is_taken_[i] = true;
      all.push_back(std::move(patch));
    }
    return all;
  }

 private:
  // Cells with flat neighbours all around, the flattest surroundings first.
  std::vector<std::pair<double, std::size_t>> seeds() const {
    std::vector<std::pair<double, std::size_t>> all;
    for (int row = 1; row + 1 < image_.rows; ++row) {
      for (int column = 1; column + 1 < image_.columns; ++column) {
        const auto seed = indexOf(column, row);
        const auto around = surroundingsOf(seed);
        if (around.size() < 9) continue;
        const auto plane = planeOf(around);
        double squares = 0;
        for (const auto i : around) squares += std::pow(missOf(i, plane), 2);
        const double rms = std::sqrt(squares / 9);
        if (rms < 0.5 * bound_) all.emplace_back(rms, seed);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  // Grows ring by ring. The plane is fitted again after each ring, so that it follows a slowly varying distortion, and
  // at the end it is fitted to all cells.
  std::vector<std::size_t> growFrom(std::size_t seed) const {
    constexpr int kRounds = 200;
    auto patch = surroundingsOf(seed);
    for (int round = 0; round < kRounds; ++round) {
      const auto plane = planeOf(patch);
      std::vector<std::size_t> next;
      std::vector<bool> is_in(corrected_.size(), false);
      for (const auto i : patch) is_in[i] = isOn(i, plane);
      for (const auto i : patch)
        if (is_in[i]) next.push_back(i);
      const auto kept = next.size();
      for (std::size_t k = 0; k < kept; ++k) {
        for (const auto i : neighboursOf(next[k])) {
          if (is_in[i] || !isOn(i, plane)) continue;
          is_in[i] = true;
          next.push_back(i);
        }
      }
      std::sort(next.begin(), next.end());
      if (next == patch) break;
      patch = std::move(next);
      if (patch.size() < 9) break;
    }
    return patch;
  }

  bool isOn(std::size_t i, const Eigen::Vector3d& plane) const {
    const auto& cell = image_.cells[i];
    if (!cell.is_flat || is_taken_[i] || std::abs(missOf(i, plane)) > bound_) return false;
    const double steeper =
        std::hypot((cell.slope_x - plane[1]) / image_.columns, (cell.slope_y - plane[2]) / image_.rows);
    return 2 * steeper < kSteeper;
  }
  double missOf(std::size_t i, const Eigen::Vector3d& plane) const {
    return corrected_[i] - valueOf(plane, image_.cells[i].x, image_.cells[i].y);
  }
  Eigen::Vector3d planeOf(const std::vector<std::size_t>& patch) const {
    PlaneSums sums;
    for (const auto i : patch) sums.add(image_.cells[i].x, image_.cells[i].y, corrected_[i]);
    return sums.plane();
  }
  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.columns) + static_cast<std::size_t>(column);
  }
  std::vector<std::size_t> neighboursOf(std::size_t i) const {
    const int column = static_cast<int>(i) % image_.columns, row = static_cast<int>(i) / image_.columns;
    std::vector<std::size_t> all;
    if (column > 0) all.push_back(i - 1);
    if (column + 1 < image_.columns) all.push_back(i + 1);
    if (row > 0) all.push_back(indexOf(column, row - 1));
    if (row + 1 < image_.rows) all.push_back(indexOf(column, row + 1));
    return all;
  }
  // The cell itself and its eight neighbours, as far as they are flat and in no plane yet.
  std::vector<std::size_t> surroundingsOf(std::size_t i) const {
    const int column = static_cast<int>(i) % image_.columns, row = static_cast<int>(i) / image_.columns;
    std::vector<std::size_t> all;
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = column - 1; x <= column + 1; ++x) {
        const auto at = indexOf(x, y);
        if (image_.cells[at].is_flat && !is_taken_[at]) all.push_back(at);
      }
    }
    return all;
  }

  const DepthCells& image_;
  double bound_;
  std::vector<double> corrected_;
  std::vector<bool> is_taken_;
};

}  // namespace

std::vector<FlatPatch> growPatches(const DepthCells& image, const DepthDistortion& known, double bound) {
  std::vector<FlatPatch> all;
  for (const auto& cells : Growth(image, known, bound).grow()) {
    FlatPatch patch;
    for (const auto i : cells) {
      const auto& cell = image.cells[i];
      patch.samples.push_back({cell.x, cell.y, cell.inverse_depth});
    }
    all.push_back(std::move(patch));
  }
  return all;
}

Eigen::Vector3d fitPlane(const FlatPatch& patch, const DepthDistortion& known, double scale) {
  constexpr int kRounds = 10;
  std::vector<double> corrected;
  for (const auto& s : patch.samples) corrected.push_back(s.inverse_depth + known.at(s.x, s.y));
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    PlaneSums sums;
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      const auto& s = patch.samples[i];
      const double miss = round == 0 ? 0 : (corrected[i] - valueOf(plane, s.x, s.y)) / scale;
      sums.add(s.x, s.y, corrected[i], 1 / (1 + miss * miss));
    }
    plane = sums.plane();
  }
  return plane;
}

std::vector<double> missesOf(const FlatPatch& patch, const DepthDistortion& known, double scale) {
  const auto plane = fitPlane(patch, known, scale);
  std::vector<double> misses;
  for (const auto& s : patch.samples) misses.push_back(s.inverse_depth + known.at(s.x, s.y) - valueOf(plane, s.x, s.y));
  return misses;
}

}  // namespace omnimapper::calibration
