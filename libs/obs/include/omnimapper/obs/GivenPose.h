#pragma once

#include <mrpt/obs/CObservationRobotPose.h>

#include <optional>

namespace omnimapper::obs {

/// Where the base is in the frame of poses that are given: the observation tells it of a tracked body, whose place on
/// the base is its sensorPose. None if that is not finite.
inline std::optional<mrpt::poses::CPose3D> referenceFromBase(const mrpt::obs::CObservationRobotPose& given) {
  const mrpt::poses::CPose3D pose = given.pose.mean + (-given.sensorPose);
  if (!pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().allFinite()) return std::nullopt;
  return pose;
}

}  // namespace omnimapper::obs
