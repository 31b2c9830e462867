#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace omnimapper::plugins {

/// The cubes of a grid that contain points. Points [m] lie within 2^20 sides of the origin.
class PointGrid {
 public:
  /// `side`: of a cube [m], positive.
  explicit PointGrid(double side) : side_(static_cast<float>(side)) {}
  PointGrid(double side, const std::vector<Eigen::Vector3f>& points) : PointGrid(side) { add(points); }

  /// Returns true if no point was in its cube before.
  bool add(const Eigen::Vector3f& point) { return cubes_.insert(keyOf(cubeOf(point))).second; }
  void add(const std::vector<Eigen::Vector3f>& points) {
    for (const auto& point : points) add(point);
  }
  /// Whether the cube of a point has a point.
  bool has(const Eigen::Vector3f& point) const { return cubes_.count(keyOf(cubeOf(point))) > 0; }
  /// Whether that cube or one of the 26 around it has a point: every point within `side` is found, none beyond
  /// 2 sqrt(3) sides.
  bool hasNear(const Eigen::Vector3f& point) const {
    const Cube middle = cubeOf(point);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z)
          if (cubes_.count(keyOf({middle.x + x, middle.y + y, middle.z + z})) > 0) return true;
    return false;
  }
  bool empty() const { return cubes_.empty(); }
  std::size_t size() const { return cubes_.size(); }

 private:
  struct Cube {
    std::int64_t x, y, z;
  };
  Cube cubeOf(const Eigen::Vector3f& point) const {
    const auto cell = [&](float coordinate) { return static_cast<std::int64_t>(std::floor(coordinate / side_)); };
    return {cell(point.x()), cell(point.y()), cell(point.z())};
  }
  static std::uint64_t keyOf(const Cube& cube) {
    constexpr std::int64_t kHalf = 1 << 20;
    const auto part = [](std::int64_t cell) { return static_cast<std::uint64_t>(cell + kHalf) & 0x1FFFFF; };
    return part(cube.x) << 42 | part(cube.y) << 21 | part(cube.z);
  }

  float side_;
  std::unordered_set<std::uint64_t> cubes_;
};

/// The share of the points, 0 to 1, that are near one of the grid (hasNear()). Of more than 200 points, 200 are tried.
double shareNear(const PointGrid& grid, const std::vector<Eigen::Vector3f>& points);

}  // namespace omnimapper::plugins
