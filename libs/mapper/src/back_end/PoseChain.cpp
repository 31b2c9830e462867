#include "back_end/PoseChain.h"

#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>

namespace omnimapper::mapper {

namespace {

using mrpt::poses::CPose3D;

std::vector<base::Stamp> stampsOf(const std::vector<map::DependentFrame>& dependents) {
  std::vector<base::Stamp> stamps;
  for (const auto& frame : dependents) stamps.push_back(frame.stamp);
  return stamps;
}

}  // namespace

void PoseChain::beginSession(const map::Session& session, const std::optional<SessionStart>& start, bool absolute) {
  map_.sessions.push_back(session);
  start_ = start;
  absolute_ = absolute;
  links_.clear();
  hold_.reset();
  held_.reset();
  retired_.reset();
}

void PoseChain::retire(base::KeyFrameId id) {
  links_.erase(id);
  retired_ = id;
}

const map::KeyFrame* PoseChain::frameBefore(base::Stamp stamp) const {
  const std::size_t position = map_.key_frames.lowerBound(session(), stamp);
  if (position == 0 || map_.key_frames[position - 1].id.session != session()) return nullptr;
  return &map_.key_frames[position - 1];
}

const map::KeyFrame* PoseChain::frameAfter(base::Stamp stamp) const {
  const std::size_t position = map_.key_frames.lowerBound(session(), stamp);
  if (position == map_.key_frames.size() || map_.key_frames[position].id.session != session()) return nullptr;
  return &map_.key_frames[position];
}

std::optional<base::Stamp> PoseChain::lastAtOrBefore(base::Stamp stamp) const {
  const map::KeyFrame* at = frameAfter(stamp);
  if (!at || at->stamp != stamp) at = frameBefore(stamp);
  return at ? std::make_optional(at->stamp) : std::nullopt;
}

std::optional<base::Stamp> PoseChain::newest() const {
  if (map_.key_frames.empty() || map_.key_frames.back().id.session != session()) return std::nullopt;
  return map_.key_frames.back().stamp;
}

std::optional<WatchedPose> PoseChain::at(base::Stamp stamp) const {
  const map::KeyFrame* frame = frameAfter(stamp);
  if (frame && frame->stamp == stamp)
    return WatchedPose{frame->id, {CPose3D(), Eigen::Matrix<double, 6, 6>::Zero()}, frame->map_from_base};
  frame = frameBefore(stamp);
  if (!frame) return std::nullopt;
  const auto since = motion(frame->stamp, stamp, true);
  if (!since) return std::nullopt;
  return WatchedPose{frame->id, *since, frame->map_from_base + since->begin_from_end};
}

std::optional<PoseChain::Place> PoseChain::place(base::Stamp stamp) {
  const map::KeyFrame *before = frameBefore(stamp), *after = frameAfter(stamp);
  Place place{{}, true, {}, {}};
  if (after && after->stamp == stamp) return Place{after->id, false, {}, {}};
  if (retired_ && (!before || before->stamp <= map_.keyFrame(*retired_).stamp)) return std::nullopt;
  SpanMotions to, from;
  if (before) {
    place.before = before->id;
    to = motionBetween(before->stamp, stamp, true);
    if (to.motions.empty()) return std::nullopt;
  }
  if (after) {
    place.after = after->id;
    from = motionBetween(stamp, after->stamp, true);
    if (from.motions.empty()) return std::nullopt;
  }
  const CPose3D guess = before   ? before->map_from_base + to.motions.front().second.begin_from_end
                        : after  ? after->map_from_base + (-from.motions.front().second.begin_from_end)
                        : start_ ? start_->map_from_base
                                 : CPose3D();
  if (before && after) {
    // A measured motion over the whole span is not replaced by the guess of a fallback.
    const bool guessed = to.by_guess || from.by_guess;
    if (guessed && !links_[*place.before].by_guess) return std::nullopt;
    unlink(*place.before);
  }
  map::KeyFrame frame = newFrame(stamp, guess);
  place.id = frame.id;
  const base::VariableId pose = frame.pose;
  std::vector<base::Stamp> dependents;
  if (before) dependents = stampsOf(before->dependents);
  map_.key_frames.insert(std::move(frame));
  if (before) link(*place.before, place.id, to);
  if (after) link(place.id, *place.after, from);
  if (!before) hold(pose);
  // Dependent frames of the key frame before that are later than the new one become dependent frames of the new one.
  const auto later = std::upper_bound(dependents.begin(), dependents.end(), stamp);
  const auto earlier = std::lower_bound(dependents.begin(), later, stamp);
  if (before && earlier != dependents.end()) reattach(*place.before, {dependents.begin(), earlier});
  if (later != dependents.end()) reattach(place.id, {later, dependents.end()});
  map_.key_frames.edit(place.id).reference = earlier != later;
  return place;
}

map::KeyFrame PoseChain::newFrame(base::Stamp stamp, const CPose3D& map_from_base) {
  map::KeyFrame frame;
  frame.id = map_.key_frames.nextId(session());
  frame.stamp = stamp;
  frame.map_from_base = map_from_base;
  frame.pose = graph_.addVariable(poseVariable(motion_), poseValue(motion_, map_from_base));
  return frame;
}

// Holds the first pose of a session, which has no predecessor. If another pose was the first until now, it is released.
void PoseChain::hold(base::VariableId first_pose) {
  constexpr char kOwner[] = "engine";
  // If absolute measurements place the map, the first pose is only an initial value: its prior is a kilometre wide and
  // leaves all rotations open.
  constexpr double kAnywhere = 1e3;
  const Eigen::Matrix<double, 6, 6> anywhere = kAnywhere * kAnywhere * Eigen::Matrix<double, 6, 6>::Identity();
  map::Session& session = map_.sessions.back();
  if (start_) {
    // The start stays attached to the pose that came first, even if a late one precedes it.
    if (hold_) return;
    session.anchor = graph_.addVariable(poseVariable(motion_), poseValue(motion_, start_->map_from_base));
    graph_.addFactor(startFactor(motion_, session.anchor,
                                 absolute_ ? SessionStart{start_->map_from_base, kAnywhere, kAnywhere} : *start_));
    RelativeMotion none{{}, Eigen::Matrix<double, 6, 6>::Zero()};
    hold_ = graph_.addFactor(betweenPoses(motion_, session.anchor, first_pose, none, kOwner));
    return;
  }
  if (absolute_) {
    if (hold_) graph_.removeFactor(*hold_);
    hold_ = graph_.addFactor(posePrior(motion_, first_pose, {}, anywhere, kOwner));
  } else {
    if (held_) graph_.setFixed(*held_, false);
    graph_.setFixed(first_pose, true);
    held_ = first_pose;
  }
  session.anchor = first_pose;
}

void PoseChain::link(base::KeyFrameId begin, base::KeyFrameId end, const SpanMotions& span) {
  map::KeyFrame& frame = map_.key_frames.edit(begin);
  const base::VariableId end_pose = map_.keyFrame(end).pose;
  links_[begin].by_guess = span.by_guess;
  for (const auto& [section, motion] : span.motions) {
    links_[begin].factors.push_back(graph_.addFactor(betweenPoses(motion_, frame.pose, end_pose, motion, section)));
  }
  frame.keyframe_from_next = span.motions.front().second.begin_from_end;
}

void PoseChain::unlink(base::KeyFrameId begin) {
  for (const auto id : links_[begin].factors) graph_.removeFactor(id);
  links_.erase(begin);
}

// The motion is summed step by step, because the cost of asking for the whole span would grow while the robot rests. If
// no motion is known, a frame gets the pose of the one before it.
void PoseChain::reattach(base::KeyFrameId begin, const std::vector<base::Stamp>& stamps) {
  map::KeyFrame& frame = map_.key_frames.edit(begin);
  frame.dependents.clear();
  base::Stamp reached = frame.stamp;
  CPose3D keyframe_from_base;
  for (const auto stamp : stamps) {
    if (const auto step = motion(reached, stamp, true)) keyframe_from_base = keyframe_from_base + step->begin_from_end;
    frame.dependents.push_back({stamp, keyframe_from_base});
    reached = stamp;
  }
}

bool PoseChain::attach(base::Stamp stamp) {
  const map::KeyFrame* after = frameAfter(stamp);
  if (after && after->stamp == stamp) {
    map_.key_frames.edit(after->id).reference = true;
    return true;
  }
  const map::KeyFrame* before = frameBefore(stamp);
  if (!before) return false;
  map::KeyFrame& frame = map_.key_frames.edit(before->id);
  auto place =
      std::lower_bound(frame.dependents.begin(), frame.dependents.end(), stamp,
                       [](const map::DependentFrame& other, base::Stamp wanted) { return other.stamp < wanted; });
  if (place != frame.dependents.end() && place->stamp == stamp) return true;
  const bool first = place == frame.dependents.begin();
  const auto span = motion(first ? frame.stamp : std::prev(place)->stamp, stamp, true);
  if (!span) return false;
  const CPose3D start = first ? CPose3D() : std::prev(place)->keyframe_from_base;
  frame.dependents.insert(place, {stamp, start + span->begin_from_end});
  return true;
}

void PoseChain::relink(base::Stamp begin, base::Stamp end) {
  const map::KeyFrame* first = frameBefore(begin);
  std::size_t position = first ? map_.key_frames.position(first->id) : map_.key_frames.lowerBound(session(), begin);
  for (; position < map_.key_frames.size() && map_.key_frames[position].stamp < end; ++position) {
    const base::KeyFrameId id = map_.key_frames[position].id;
    if (retired_ && map_.key_frames[position].stamp <= map_.keyFrame(*retired_).stamp) continue;
    if (position + 1 < map_.key_frames.size()) {
      const map::KeyFrame& next = map_.key_frames[position + 1];
      const auto span = motionBetween(map_.key_frames[position].stamp, next.stamp, true);
      const bool worse = span.motions.empty() || (span.by_guess && !links_[id].by_guess);
      if (worse) continue;  // the older measurements stay
      unlink(id);
      link(id, next.id, span);
    }
    reattach(id, stampsOf(map_.keyFrame(id).dependents));
  }
}

// The motions of all sources that cover the span, or of the first fallback that does.
PoseChain::SpanMotions PoseChain::motionBetween(base::Stamp begin, base::Stamp end, bool or_guess) const {
  SpanMotions span;
  for (const bool fallback : {false, true}) {
    if (!span.motions.empty()) break;
    for (const auto& [section, plugin] : sources_) {
      if (plugin->isFallback() != fallback || !(or_guess || plugin->measures())) continue;
      const auto motion = plugin->between(begin, end);
      if (!motion) continue;
      span.motions.emplace_back(section, *motion);
      span.by_guess = !plugin->measures();
      if (fallback) break;
    }
  }
  return span;
}

std::optional<RelativeMotion> PoseChain::motion(base::Stamp begin, base::Stamp end, bool or_guess) const {
  auto span = motionBetween(begin, end, or_guess);
  if (span.motions.empty()) return std::nullopt;
  return std::move(span.motions.front().second);
}

}  // namespace omnimapper::mapper
