#include "front_end/InputFilter.h"

namespace omnimapper::mapper {

bool InputFilter::accepts(const mrpt::obs::CObservation& observation, RunCounts& counts) {
  if (!base::isValid(observation.timestamp)) {
    ++counts.no_stamp;
    return false;
  }
  const auto [last, first] =
      last_[observation.GetRuntimeClass()].try_emplace(observation.sensorLabel, observation.timestamp);
  if (!first && last->second == observation.timestamp) {
    ++counts.repeated_stamp;
    return false;
  }
  last->second = observation.timestamp;
  mrpt::poses::CPose3D base_from_sensor;
  observation.getSensorPose(base_from_sensor);
  if (!base_from_sensor.m_coords.asEigen().allFinite() || !base_from_sensor.getRotationMatrix().asEigen().allFinite()) {
    ++counts.unusable;
    return false;
  }
  return true;
}

}  // namespace omnimapper::mapper
