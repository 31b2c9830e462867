// What laser odometry leaves out: scans that the laser repeats, and beams on things that move.
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "ScanOdometryPlugin.h"
#include "UsableScan.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

// A slow base moves less than that from scan to scan, so the motion is added up since the ranges changed last.
bool ScanOdometryPlugin::isFrozen(const mrpt::obs::CObservation2DRangeScan& scan) const {
  constexpr double kMoved = 0.02, kTurned = 0.02;  // [m] [rad]
  const bool has_moved = std::any_of(odometries_.begin(), odometries_.end(), [](const Odometry& odometry) {
    if (!odometry.measured) return false;
    const TPose2D moved = odometry.unseen + *odometry.measured;
    return std::hypot(moved.x, moved.y) > kMoved || std::abs(mrpt::math::wrapToPi(moved.phi)) > kTurned;
  });
  return has_moved && matched_ && haveSameRanges(scan, *matched_);
}

void ScanOdometryPlugin::addUpMotion(const mrpt::obs::CObservation2DRangeScan& matched) {
  const bool is_repeated = matched_ && haveSameRanges(matched, *matched_);
  for (auto& odometry : odometries_) {
    if (!is_repeated)
      odometry.unseen = {};
    else if (odometry.measured)
      odometry.unseen = odometry.unseen + *odometry.measured;
  }
}

void ScanOdometryPlugin::leaveOut(const mrpt::obs::CObservation2DRangeScan& scan) {
  constexpr double kStuck = 30;  // [s] for which the wheels' motions are kept, so that a match can bridge them
  const base::Stamp stamp = middleOf(scan);
  if (frozen_.scans++ == 0) frozen_.first = base::secondsBetween(*begun_, stamp);
  unusable_.emplace(scan.timestamp, std::nullopt);
  if (!last_ || base::secondsBetween(*last_, stamp) <= std::max(kStuck, options_.max_gap)) return;
  is_stuck_ = true;
  last_.reset();
}

mrpt::obs::CObservation::ConstPtr ScanOdometryPlugin::usablePart(
    const mrpt::obs::CObservation::ConstPtr& observation) const {
  if (!label_ || observation->sensorLabel != *label_) return observation;
  const auto found = unusable_.find(observation->timestamp);
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
  if (found == unusable_.end() || !scan) return observation;
  if (!found->second) return nullptr;
  return withoutBeamsNear(*found->second, near_, *scan);
}

void ScanOdometryPlugin::forgetBefore(base::Stamp stamp) {
  timeline_.forgetBefore(stamp);
  unusable_.erase(unusable_.begin(), unusable_.lower_bound(stamp));
}

}  // namespace omnimapper::plugins
