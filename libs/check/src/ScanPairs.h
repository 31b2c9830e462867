#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/Stamp.h>

#include <functional>
#include <optional>
#include <vector>

namespace omnimapper::check {

using ScanPtr = std::shared_ptr<const mrpt::obs::CObservation2DRangeScan>;

/// Two scans of one laser, half a second or so apart.
struct ScanPair {
  ScanPtr begin, end;
};

/// Picks pairs evenly over a log whose length is not known beforehand.
class ScanPairs {
 public:
  void add(const ScanPtr& scan);
  const std::vector<ScanPair>& pairs() const { return pairs_; }

 private:
  std::vector<ScanPair> pairs_;
  std::size_t ended_ = 0, stride_ = 1;  // every stride-th pair is kept
  ScanPtr begin_;
};

/// Motion of the base over a pair by scan matching.
struct MatchedMotion {
  base::Stamp begin, end;
  mrpt::poses::CPose2D by_scans;  ///< base at the end in the base at the begin
  std::optional<mrpt::poses::CPose2D> by_odometry;
  double wall_distance;  ///< [m] root mean square of the points of one to the walls of the other
  double seconds() const { return base::secondsBetween(begin, end); }
};

using OdometryBetween = std::function<std::optional<mrpt::poses::CPose2D>(base::Stamp, base::Stamp)>;

/// Copies of the scans with that aperture [rad].
std::vector<ScanPair> withAperture(const std::vector<ScanPair>& pairs, double aperture);

/// Matches each pair, from rest and from the odometry's motion, and gives those that fit and whose walls fix the pose.
std::vector<MatchedMotion> matchPairs(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry);

}  // namespace omnimapper::check
