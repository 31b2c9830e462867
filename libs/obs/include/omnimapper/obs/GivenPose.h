#pragma once

#include <mrpt/obs/CObservationRobotPose.h>

#include <optional>

namespace omnimapper::obs {

/// Pose of the base in the frame of given poses. The observation states the pose of a tracked body, whose pose on the
/// base is sensorPose. None if the result is not finite.
inline std::optional<mrpt::poses::CPose3D> referenceFromBase(const mrpt::obs::CObservationRobotPose& given) {
  const mrpt::poses::CPose3D pose = given.pose.mean + (-given.sensorPose);
  if (!pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().allFinite()) return std::nullopt;
  return pose;
}

}  // namespace omnimapper::obs
