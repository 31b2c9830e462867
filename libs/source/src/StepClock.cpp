#include "StepClock.h"

#include <algorithm>

namespace omnimapper::source {

StepClock::Who StepClock::whoIs(const mrpt::obs::CObservation& observation) {
  return {observation.sensorLabel, observation.GetRuntimeClass()->className};
}

base::Stamp StepClock::now(base::Stamp own) {
  if (!first_) first_ = base::isValid(own) ? own : base::stampFromUnix(1e9);
  return *first_ + base::durationFromSeconds(step_ * static_cast<double>(steps_));
}

void StepClock::stamp(mrpt::obs::CActionCollection& actions) {
  if (!(step_ > 0)) return;
  if (!seen_.insert(Who()).second) ++steps_, seen_ = {Who()};
  for (auto& action : actions) action->timestamp = now(action->timestamp);
}

void StepClock::stamp(const mrpt::obs::CSensoryFrame& frame) {
  if (!(step_ > 0)) return;
  const bool is_next = std::any_of(frame.begin(), frame.end(), [&](const auto& observation) {
    return observation && seen_.count(whoIs(*observation)) > 0;
  });
  if (is_next) ++steps_, seen_.clear();
  for (const auto& observation : frame) {
    if (!observation) continue;
    seen_.insert(whoIs(*observation));
    observation->timestamp = now(observation->timestamp);
  }
}

void StepClock::stamp(mrpt::obs::CObservation& observation) {
  if (!(step_ > 0)) return;
  if (!seen_.insert(whoIs(observation)).second) ++steps_, seen_ = {whoIs(observation)};
  observation.timestamp = now(observation.timestamp);
}

}  // namespace omnimapper::source
