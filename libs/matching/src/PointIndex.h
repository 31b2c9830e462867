#pragma once

#include <omnimapper/matching/ScanMatcher.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::matching {

/// Points sorted into the square cells of a grid, to find the nearest one within a distance.
class PointIndex : public MatchReference {
 public:
  explicit PointIndex(const ScanWithNormals& scan);

  static constexpr int kNone = -1;
  /// Index of the nearest point within `max_distance` [m], or kNone. `likely`: a point that may be the nearest, or
  /// kNone. A good one makes the search short, and it is preferred to others that are exactly as near.
  int nearest(float x, float y, float max_distance, int likely = kNone) const;

  std::size_t size() const { return xs_.size(); }
  /// In the order of the index; normals are zero where there is no line.
  const std::vector<float>& xs() const { return xs_; }
  const std::vector<float>& ys() const { return ys_; }
  const std::vector<float>& normalXs() const { return normal_xs_; }
  const std::vector<float>& normalYs() const { return normal_ys_; }

 private:
  std::vector<float> xs_, ys_, normal_xs_, normal_ys_;         // cell by cell
  std::vector<std::uint32_t> first_;                           // index of the first point of each cell, and the end
  float min_x_ = 0, min_y_ = 0, side_ = 1, inverse_side_ = 1;  // [m] [1/m]
  int columns_ = 0;
  float last_column_ = 0, last_row_ = 0;
};

}  // namespace omnimapper::matching
