#include "ActionSpans.h"

#include <omnimapper/geometry/Conversions.h>

namespace omnimapper::source {

ActionSpans::Motions ActionSpans::addAction(const mrpt::obs::CActionCollection& actions) {
  base::Stamp stamp;
  for (const auto& action : actions) {
    const auto motion = motionOf(action.get_ptr());
    if (!motion) continue;
    const auto [place, is_new] = pending_.emplace(motion->origin, *motion);
    if (!is_new) place->second = join(place->second, *motion);
    if (base::isValid(action->timestamp)) stamp = action->timestamp;
  }
  if (pending_.empty()) return {};
  if (base::isValid(stamp)) {
    pending_stamp_ = stamp;
    if (mode_ == ActionSpan::automatic) mode_ = ActionSpan::own;
  }
  if (mode_ != ActionSpan::own) return {};
  // A first action from before the first frame only determines where the span of the next one begins.
  if (!has_motion_ && base::isValid(stamp) && stamp <= begin_) has_begin_ = false;
  return spanUntil(stamp);
}

ActionSpans::Motions ActionSpans::addFrame(base::Stamp stamp) {
  pending_stamp_ = base::Stamp();
  if (mode_ == ActionSpan::automatic && has_begin_ && !pending_.empty()) mode_ = ActionSpan::frames;
  if (mode_ == ActionSpan::own && has_begin_ && base::isValid(begin_)) return {};
  return spanUntil(stamp);
}

ActionSpans::Motions ActionSpans::spanUntil(base::Stamp end) {
  if (!has_begin_) {
    dropPending();
    has_begin_ = true;
    begin_ = end;
    return {};
  }
  if (!base::isValid(begin_)) {
    // Nothing had a stamp so far, so the motions until here have none either.
    auto motions = takePending(base::Stamp(), base::Stamp());
    begin_ = end;
    return motions;
  }
  if (pending_.empty() || !base::isValid(end) || end <= begin_) return {};
  auto motions = takePending(begin_, end);
  begin_ = end;
  return motions;
}

ActionSpans::Motions ActionSpans::takePending(base::Stamp begin, base::Stamp end) {
  Motions motions;
  for (const auto& [origin, motion] : pending_) {
    auto observation = obs::CObservationRelativeMotion::Create();
    observation->begin = begin;
    observation->timestamp = end;
    observation->sensorLabel = origin.empty() ? label_ : label_ + "_" + origin;
    observation->begin_from_end = geometry::toMrpt(motion.begin_from_end);
    observation->covariance = motion.covariance;
    motions.push_back(observation);
  }
  pending_.clear();
  has_motion_ = true;
  return motions;
}

void ActionSpans::dropPending() {
  for (const auto& [origin, motion] : pending_) dropped_ += motion.actions;
  pending_.clear();
}

}  // namespace omnimapper::source
