#include "OdometryStatistics.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::check {

namespace {
constexpr double kJump = 0.5;        // [m]
constexpr double kFastestRobot = 5;  // [m/s]

bool isFinite(const mrpt::poses::CPose2D& pose) {
  return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi());
}

// Whether two odometries differ over a span by more than slip and held or interpolated readings can explain.
bool areContrary(const mrpt::poses::CPose2D& a, const mrpt::poses::CPose2D& b) {
  constexpr double kLeast = 0.15, kLeastTurn = 0.15;  // [m] [rad]
  constexpr double kShare = 0.3;
  const double off = std::hypot(a.x() - b.x(), a.y() - b.y());
  const double turned_off = std::abs(mrpt::math::wrapToPi(a.phi() - b.phi()));
  return off > kLeast + kShare * std::max(a.norm(), b.norm()) ||
         turned_off > kLeastTurn + kShare * std::max(std::abs(a.phi()), std::abs(b.phi()));
}
}  // namespace

bool OdometryStatistics::isOdometry(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation) ||
         dynamic_cast<const obs::CObservationRelativeMotion*>(&observation);
}

void OdometryStatistics::add(const mrpt::obs::CObservation& observation) {
  ++facts_.readings;
  source_.add(observation);
  const auto stamp = observation.timestamp;
  if (base::isValid(stamp)) stamps_.push_back(stamp);
  if (const auto* motion = dynamic_cast<const obs::CObservationRelativeMotion*>(&observation)) {
    const mrpt::poses::CPose2D step(motion->begin_from_end);
    if (!isFinite(step)) {
      ++facts_.not_finite;
    } else {
      addStep(step, base::secondsBetween(motion->begin, stamp), stamp);
    }
    return;
  }
  const auto& pose = dynamic_cast<const mrpt::obs::CObservationOdometry&>(observation).odometry;
  if (!isFinite(pose)) {
    ++facts_.not_finite;
    return;
  }
  if (previous_) addStep(pose - *previous_, base::secondsBetween(previous_stamp_, stamp), stamp);
  previous_ = pose;
  previous_stamp_ = stamp;
}

void OdometryStatistics::addStep(const mrpt::poses::CPose2D& step, double seconds, base::Stamp stamp) {
  const double travel = step.norm();
  if (travel > kJump + kFastestRobot * std::abs(seconds)) {
    ++facts_.jumps;
    if (travel > facts_.largest_jump) {
      facts_.largest_jump = travel;
      facts_.largest_at = stamp;
    }
    return;
  }
  facts_.travel += travel;
  facts_.turn += std::abs(step.phi());
}

std::optional<mrpt::poses::CPose2D> OdometryStatistics::between(base::Stamp begin, base::Stamp end) const {
  const auto motion = source_.between(begin, end);
  if (!motion) return std::nullopt;
  return mrpt::poses::CPose2D(motion->begin_from_end);
}

Headings OdometryStatistics::headings() const {
  return headingsOf(stamps_, [this](base::Stamp begin, base::Stamp end) {
    const auto motion = between(begin, end);
    return motion ? motion->phi() : std::nan("");
  });
}

OdometryPair compareOdometries(const std::string& a, const OdometryStatistics& of_a, const std::string& b,
                               const OdometryStatistics& of_b) {
  constexpr double kShortest = 1;  // [s] of a span
  constexpr std::size_t kMostSpans = 500;
  constexpr double kMoved = 0.1;  // [m] [rad]
  OdometryPair pair;
  pair.a = a;
  pair.b = b;
  const auto& stamps = (of_a.stamps().size() < of_b.stamps().size() ? of_a : of_b).stamps();
  std::vector<std::pair<base::Stamp, base::Stamp>> spans;
  for (std::size_t begin = 0, end = 0; end < stamps.size(); ++end) {
    if (std::abs(base::secondsBetween(stamps[begin], stamps[end])) < kShortest) continue;
    if (stamps[begin] < stamps[end]) spans.emplace_back(stamps[begin], stamps[end]);
    begin = end;
  }
  const std::size_t stride = spans.size() / kMostSpans + 1;
  for (std::size_t i = 0; i < spans.size(); i += stride) {
    const auto by_a = of_a.between(spans[i].first, spans[i].second);
    const auto by_b = of_b.between(spans[i].first, spans[i].second);
    if (!by_a || !by_b) continue;
    if (std::max({by_a->norm(), by_b->norm(), std::abs(by_a->phi()), std::abs(by_b->phi())}) < kMoved) continue;
    ++pair.spans;
    if (!areContrary(*by_a, *by_b)) continue;
    if (pair.contrary++ == 0) pair.first_contrary = spans[i].first;
  }
  return pair;
}

}  // namespace omnimapper::check
