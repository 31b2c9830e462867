#include "PoseStatistics.h"

#include <omnimapper/obs/GivenPose.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::check {

void PoseStatistics::add(const mrpt::obs::CObservationRobotPose& observation) {
  const auto reference_from_base = obs::referenceFromBase(observation);
  if (!reference_from_base) return;
  ++poses_;
  up_ += reference_from_base->getRotationMatrix()(2, 2);
}

PoseFacts PoseStatistics::facts() const {
  PoseFacts facts;
  facts.poses = poses_;
  if (poses_ > 0) facts.tilt = std::acos(std::clamp(up_ / static_cast<double>(poses_), -1.0, 1.0));
  return facts;
}

}  // namespace omnimapper::check
