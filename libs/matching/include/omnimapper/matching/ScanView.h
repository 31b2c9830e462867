#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <array>

namespace omnimapper::matching {

/// What one scan saw from its place: for each degree around the laser the range of the nearest point. It tells whether
/// beams passed a place freely.
class ScanView {
 public:
  /// `sensor`: position of the laser in the scan's frame [m].
  ScanView(const mrpt::math::TPose2D& frame_from_scan, const Eigen::Vector2f& sensor, const ScanWithNormals& scan);

  enum class Seen { unknown, free, occupied, hidden };
  /// What the beams next to the direction of `place` (in the frame, [m]) say: all passed it freely, with `margin` [m]
  /// to spare; one ended within the margin; or one ended before it.
  Seen at(const Eigen::Vector2f& place, float margin) const;
  /// Distance of a place from the laser [m].
  float distance(const Eigen::Vector2f& place) const { return (place - origin_).norm(); }
  const Eigen::Vector2f& origin() const { return origin_; }

 private:
  static constexpr int kBins = 360;
  static int binOf(const Eigen::Vector2f& direction);

  Eigen::Vector2f origin_;
  std::array<float, kBins> nearest_;  // [m] 0: no point in this direction
};

}  // namespace omnimapper::matching
