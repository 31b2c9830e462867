#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace omnimapper::geometry {

/// The set of those cubes of a grid that contain a point; it serves to keep one point for each cube.
class CubeSet {
 public:
  /// `side`: length of a cube's edges [m]; 0: every point has a cube of its own.
  explicit CubeSet(double side) : side_(side) {}

  /// Adds a point [m] within 2^20 sides of the origin. Returns true if no point was in its cube before.
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
