#include "LevelEvidence.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/matching/ScanInBase.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

void LevelEvidence::add(const mrpt::obs::CObservation& observation) {
  constexpr std::size_t kMost = 16;  // more than any robot has; a damaged log may have any number of labels
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
    const auto known = imus_.find(imu->sensorLabel);
    if (known != imus_.end() || imus_.size() < kMost) imus_[imu->sensorLabel].add(*imu);
    return;
  }
  if (!level_base_.empty()) return;
  if (dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    level_base_ = "wheel odometry '" + observation.sensorLabel + "'";
  } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    const double up = std::abs(scan->sensorPose.getRotationMatrix()(2, 2));
    if (std::acos(std::min(1.0, up)) < matching::kLargestTilt)
      level_base_ =
          scan->sensorLabel.empty() ? "a 2D laser without a label" : "the 2D laser '" + scan->sensorLabel + "'";
  }
}

}  // namespace omnimapper::plugins
