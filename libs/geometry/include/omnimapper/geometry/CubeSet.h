#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace omnimapper::geometry {

/// The cubes of a grid that contain a point, to keep one point of each.
class CubeSet {
 public:
  /// `side` [m]; 0: every point has a cube of its own.
  explicit CubeSet(double side) : side_(side) {}

  /// Adds a point [m] within 2^20 sides of the origin. True if its cube contained none before.
  bool insert(double x, double y, double z) {
    if (!(side_ > 0)) return true;
    return cubes_.insert(cell(x) << 42 | cell(y) << 21 | cell(z)).second;
  }
  void clear() { cubes_.clear(); }

 private:
  std::uint64_t cell(double coordinate) const {
    return static_cast<std::uint64_t>(std::llround(std::floor(coordinate / side_)) + (1 << 20)) & 0x1FFFFF;
  }

  double side_;
  std::unordered_set<std::uint64_t> cubes_;
};

}  // namespace omnimapper::geometry
