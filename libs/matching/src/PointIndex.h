#pragma once

#include <omnimapper/matching/ScanMatcher.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::matching {

/// Points sorted into the square cells of a grid, for the nearest one within a distance.
class PointIndex : public MatchReference {
 public:
  explicit PointIndex(PlanarScan scan);

  static constexpr int kNone = -1;
  /// Index into points() of the nearest one within `max_distance` [m], or kNone.
  int nearest(float x, float y, float max_distance) const;

  const std::vector<Eigen::Vector2f>& points() const { return points_; }
  const std::vector<Eigen::Vector2f>& normals() const { return normals_; }

 private:
  std::vector<Eigen::Vector2f> points_, normals_;  // cell by cell
  std::vector<std::uint32_t> first_;               // of each cell, and the end
  float min_x_ = 0, min_y_ = 0, side_ = 1;         // [m]
  int columns_ = 0, rows_ = 0;
};

}  // namespace omnimapper::matching
