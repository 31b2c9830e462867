#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/motion/PoseTimeline.h>

#include <algorithm>

namespace omnimapper::motion {

namespace {

using geometry::Se3;

// The pose after the share `f` of a uniform motion.
Se3 share(const Se3& motion, double f) {
  if (f <= 0) return Se3();
  if (f >= 1) return motion;
  return plus(Se3(), f * minus(motion, Se3()));
}

// The part of a span's motion between two shares of its time. Its covariance is the same share of the span's
// covariance, seen from the end of the part instead of the end of the span, so that the covariances of parts add up to
// that of the span.
RelativeMotion part(const RelativeMotion& motion, double from, double to) {
  if (from <= 0 && to >= 1) return motion;
  const Se3 whole = geometry::fromMrpt(motion.begin_from_end);
  const Se3 begin_from_part_end = share(whole, to);
  const Se3 end_from_part_end = inverse(whole) * begin_from_part_end;
  return {geometry::toMrpt(inverse(share(whole, from)) * begin_from_part_end),
          geometry::composeCovariance(motion.covariance * (to - from), end_from_part_end, geometry::Matrix6d::Zero())};
}

}  // namespace

RelativeMotion identityMotion() {
  return {mrpt::poses::CPose3D(), Eigen::Matrix<double, 6, 6>::Zero()};
}

RelativeMotion compose(const RelativeMotion& a, const RelativeMotion& b) {
  const Se3 b_motion = geometry::fromMrpt(b.begin_from_end);
  return {a.begin_from_end + b.begin_from_end, geometry::composeCovariance(a.covariance, b_motion, b.covariance)};
}

bool PoseTimeline::insert(base::Stamp begin, base::Stamp end, const RelativeMotion& motion) {
  const bool finite =
      motion.begin_from_end.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().allFinite() &&
      motion.covariance.allFinite();
  if (end <= begin || !finite) return false;
  const auto after = firstEndingAfter(begin);
  if (after != spans_.end() && after->begin < end) return false;
  spans_.insert(after, {begin, end, motion});
  return true;
}

bool PoseTimeline::remove(base::Stamp begin, base::Stamp end) {
  const auto span = firstEndingAfter(begin);
  if (span == spans_.end() || span->begin != begin || span->end != end) return false;
  spans_.erase(span);
  return true;
}

std::deque<PoseTimeline::Span>::const_iterator PoseTimeline::firstEndingAfter(base::Stamp stamp) const {
  if (spans_.empty() || spans_.back().end <= stamp) return spans_.end();
  return std::upper_bound(spans_.begin(), spans_.end(), stamp,
                          [](base::Stamp wanted, const Span& span) { return wanted < span.end; });
}

std::optional<RelativeMotion> PoseTimeline::between(base::Stamp begin, base::Stamp end) const {
  if (spans_.empty() || begin < spans_.front().begin || end > spans_.back().end || end < begin) return std::nullopt;
  RelativeMotion sum = identityMotion();
  auto span = firstEndingAfter(begin);
  base::Stamp reached = begin;
  for (; reached < end; ++span) {
    if (span == spans_.end() || span->begin > reached) return std::nullopt;
    const double length = base::secondsBetween(span->begin, span->end);
    const base::Stamp until = std::min(end, span->end);
    sum = compose(sum, part(span->motion, base::secondsBetween(span->begin, reached) / length,
                            until == span->end ? 1.0 : base::secondsBetween(span->begin, until) / length));
    reached = until;
  }
  return sum;
}

std::optional<base::Stamp> PoseTimeline::end() const {
  if (spans_.empty()) return std::nullopt;
  return spans_.back().end;
}

void PoseTimeline::forgetBefore(base::Stamp stamp) {
  while (!spans_.empty() && spans_.front().end <= stamp) spans_.pop_front();
}

}  // namespace omnimapper::motion
