#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanView.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace omnimapper::matching {

/// What some of the scans of the last seconds saw, in the frame of the track.
class RecentViews {
 public:
  static constexpr double kKept = 8;  ///< [s] for which a view is kept

  /// Keeps a view, unless the last one is too recent. `seconds`: its time, which must increase.
  void add(const ScanView& view, double seconds);

  /// By how many views a place was free, and by how many something was there.
  struct Counts {
    int free = 0, occupied = 0;
    bool isFree() const { return free >= 2 && free > 2 * occupied; }
    bool isOccupied() const { return occupied >= 2 && occupied > 2 * free; }
  };
  /// What the views until the time `until` [s] saw of a place [m]. `margin`: distance from the end of a beam, within
  /// which a place is occupied, and by which a beam must have passed a free one [m].
  Counts at(const Eigen::Vector2f& place, float margin, double until) const;
  /// The same of a thing: it was free if 70 % of its points were, and occupied if 30 % were. Views whose beams may have
  /// missed it because it is narrow do not count.
  Counts at(const std::vector<Eigen::Vector2f>& points, float margin, double until) const;
  /// Whether more walls of a scan than doors explain stand where earlier beams passed freely: then the pose is wrong.
  bool contradict(const mrpt::math::TPose2D& track_from_scan, const ScanWithNormals& scan) const;

 private:
  struct Look {
    ScanView view;
    double seconds;
  };
  std::deque<Look> looks_;  // oldest first
};

/// Whether the beams of a view cannot have missed a thing of these points because it is narrow.
bool isWideFor(const ScanView& view, const std::vector<Eigen::Vector2f>& points);

/// The share of a thing's points that a view saw free, [0, 1], and that of points where it saw something.
struct SeenShares {
  float free = 0, occupied = 0;
};
SeenShares sharesSeen(const ScanView& view, const std::vector<Eigen::Vector2f>& points, float margin);

}  // namespace omnimapper::matching
