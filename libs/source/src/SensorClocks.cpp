#include "SensorClocks.h"

#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <algorithm>

namespace omnimapper::source {

std::vector<double> SensorClocks::offsetsIn(const std::map<std::string, double>& clock_offsets) {
  std::vector<double> offsets{0};
  for (const auto& [label, offset] : clock_offsets) {
    if (std::find(offsets.begin(), offsets.end(), offset) == offsets.end()) offsets.push_back(offset);
  }
  return offsets;
}

double SensorClocks::offsetOf(const mrpt::obs::CObservation& observation) const {
  const auto found = clock_offsets_.find(observation.sensorLabel);
  return found == clock_offsets_.end() ? 0 : found->second;
}

bool SensorClocks::concerns(const mrpt::obs::CObservation& observation) const {
  return offsetOf(observation) == offset_;
}

base::Stamp SensorClocks::corrected(const mrpt::obs::CObservation& observation) const {
  return observation.timestamp + base::durationFromSeconds(offsetOf(observation));
}

void SensorClocks::correct(mrpt::obs::CObservation& observation) const {
  if (offset_ == 0) return;
  const auto offset = base::durationFromSeconds(offset_);
  if (base::isValid(observation.timestamp)) observation.timestamp += offset;
  auto* motion = dynamic_cast<obs::CObservationRelativeMotion*>(&observation);
  if (motion && base::isValid(motion->begin)) motion->begin += offset;
}

}  // namespace omnimapper::source
