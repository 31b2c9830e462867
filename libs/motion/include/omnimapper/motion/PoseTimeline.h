#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/motion/RelativeMotion.h>

#include <deque>
#include <optional>

namespace omnimapper::motion {

/// The motion of the base as one continuous source measured it, in spans of time that follow one another. Any span of
/// time inside can be requested, and spans add up: the motion and covariance of a..c are those of a..b and b..c
/// composed, wherever b lies (thesis 5.2.3.1: nothing is counted twice, nothing is lost).
class PoseTimeline {
 public:
  /// Adds the span from `begin` to `end`. False, and nothing changes, if the span is empty or reversed, overlaps
  /// another span, or its motion is not finite. There may be gaps; between() has no motion across them.
  bool insert(base::Stamp begin, base::Stamp end, const RelativeMotion& motion);
  /// Removes the span from `begin` to `end`. False, and nothing changes, if no span with these ends was added.
  bool remove(base::Stamp begin, base::Stamp end);

  /// Motion from `begin` to `end`, begin <= end; none if no motion was added for a part of it. Within a span that was
  /// added, the motion is assumed to be uniform in time.
  std::optional<RelativeMotion> between(base::Stamp begin, base::Stamp end) const;

  std::optional<base::Stamp> end() const;
  /// Drops spans that end at or before `stamp`.
  void forgetBefore(base::Stamp stamp);

 private:
  struct Span {
    base::Stamp begin, end;
    RelativeMotion motion;
  };
  std::deque<Span>::const_iterator firstEndingAfter(base::Stamp stamp) const;

  std::deque<Span> spans_;  // in order of time
};

/// The motion `a` followed by the motion `b`. The covariance is the sum of both, where that of `a` is transformed to
/// the frame at the end of `b`.
RelativeMotion compose(const RelativeMotion& a, const RelativeMotion& b);
/// No motion, known exactly.
RelativeMotion identityMotion();

}  // namespace omnimapper::motion
