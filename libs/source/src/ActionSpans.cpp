#include "ActionSpans.h"

#include <omnimapper/geometry/Conversions.h>

namespace omnimapper::source {

ActionSpans::Motions ActionSpans::addAction(const mrpt::obs::CActionCollection& actions) {
  base::Stamp stamp;
  for (const auto& action : actions) {
    const auto motion = motionOf(*action);
    if (!motion) continue;
    const auto [place, is_new] = pending_.emplace(motion->origin, *motion);
    if (!is_new) place->second = join(place->second, *motion);
    if (base::isValid(action->timestamp)) stamp = action->timestamp;
  }
  if (base::isValid(stamp)) pending_stamp_ = stamp;
  return mode_ == ActionSpan::own && !pending_.empty() ? spanning(begin_, stamp) : Motions();
}

ActionSpans::Motions ActionSpans::addFrame(base::Stamp stamp) {
  pending_stamp_ = base::Stamp();
  return mode_ == ActionSpan::frames ? spanning(begin_, stamp) : Motions();
}

ActionSpans::Motions ActionSpans::spanning(base::Stamp begin, base::Stamp end) {
  const bool joins_next = base::isValid(begin) && !base::isValid(end);
  if (joins_next) return {};
  Motions motions;
  if (any_begin_) {
    for (const auto& [origin, motion] : pending_) {
      auto observation = obs::CObservationRelativeMotion::Create();
      observation->begin = begin;
      observation->timestamp = base::isValid(begin) ? end : base::Stamp();
      observation->sensorLabel = origin.empty() ? label_ : label_ + "_" + origin;
      observation->begin_from_end = geometry::toMrpt(motion.begin_from_end);
      observation->covariance = motion.covariance;
      motions.push_back(observation);
    }
  } else {
    dropped_ += pending_.size();
  }
  pending_.clear();
  any_begin_ = true;
  begin_ = end;
  return motions;
}

void ActionSpans::finish() {
  dropped_ += pending_.size();
  pending_.clear();
}

}  // namespace omnimapper::source
