#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/Stamp.h>

#include <functional>
#include <optional>
#include <vector>

#include "ClockFit.h"

namespace omnimapper::check {

using ScanPtr = std::shared_ptr<const mrpt::obs::CObservation2DRangeScan>;

/// Two scans of one laser, about half a second after one another, and the scan that follows each; null at the end of
/// the log.
struct ScanPair {
  ScanPtr begin, end, after_begin, after_end;
};

/// Picks pairs evenly over a log whose length is not known beforehand.
class ScanPairs {
 public:
  void add(const ScanPtr& scan);
  const std::vector<ScanPair>& pairs() const { return pairs_; }

 private:
  std::vector<ScanPair> pairs_;
  std::size_t ended_ = 0, stride_ = 1;  // every stride-th pair is kept
  ScanPtr begin_, after_begin_;
  bool misses_last_ = false;  // the scan after the newest pair
};

/// Motion of the base between the scans of a pair, by scan matching and by odometry.
struct MatchedMotion {
  base::Stamp begin, end;
  mrpt::poses::CPose2D by_scans;  ///< pose of the base at the end in the base at the begin
  std::optional<mrpt::poses::CPose2D> by_odometry;
  double wall_distance;  ///< [m] root mean square of the points of one to the walls of the other
  double seconds() const { return base::secondsBetween(begin, end); }
};

/// The turns of the motions by scans.
std::vector<MeasuredTurn> turnsOf(const std::vector<MatchedMotion>& motions);

using OdometryBetween = std::function<std::optional<mrpt::poses::CPose2D>(base::Stamp, base::Stamp)>;

/// Copies of the pairs, with that aperture [rad] in their scans.
std::vector<ScanPair> withAperture(const std::vector<ScanPair>& pairs, double aperture);

/// Matches each pair, starting from rest and from the odometry's motion, and returns the matches that are good and
/// whose walls determine the pose.
std::vector<MatchedMotion> matchPairs(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry);

}  // namespace omnimapper::check
