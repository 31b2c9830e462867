#include "StampStatistics.h"

#include <algorithm>
#include <cmath>

#include "Quantile.h"

namespace omnimapper::check {

namespace {
constexpr double kJumpAhead = 60;    // [s]
constexpr double kGapOfPeriods = 5;  // and of a second at least
// If a sensor has a fixed rate, nine in ten of its steps are shorter than its period times this factor. In fhw and
// belgioioso, which were recorded by the distance driven, the factor is 2.0.
constexpr double kUnevenSteps = 1.5;

// First and last stamp without those far from nearly all others, so that one wrong stamp does not make the log a year
// long.
void setEnds(const std::vector<base::Stamp>& stamps, StampFacts& facts) {
  if (stamps.empty()) return;
  const auto low = quantile(stamps, 0.01), high = quantile(stamps, 0.99);
  const auto margin = base::durationFromSeconds(kJumpAhead) + (high - low) / 20;
  facts.first = high;
  facts.last = low;
  for (const auto stamp : stamps) {
    if (stamp >= low - margin) facts.first = std::min(facts.first, stamp);
    if (stamp <= high + margin) facts.last = std::max(facts.last, stamp);
  }
}

void countJump(double step, StampFacts& facts) {
  ++facts.jumps;
  if (std::abs(step) > std::abs(facts.largest_jump)) facts.largest_jump = step;
}

bool isGap(double step, double period) {
  return step >= std::max(1.0, kGapOfPeriods * period);
}
}  // namespace

void StreamClock::add(base::Stamp stamp) {
  if (!base::isValid(stamp)) return;
  const bool is_first = !base::isValid(newest_);
  const double ahead = is_first ? 0 : base::secondsBetween(newest_, stamp);
  if (ahead >= kJumpAhead) before_pause_ = newest_;
  if (is_first || ahead > 0 || ahead < -kJumpBack) newest_ = stamp;
}

void StampStatistics::add(base::Stamp stamp, const StreamClock& clock) {
  ++facts_.count;
  if (!base::isValid(stamp)) {
    ++facts_.no_stamp;
    return;
  }
  stamps_.push_back(stamp);
  facts_.lateness = std::max(facts_.lateness, base::secondsBetween(stamp, clock.newest()));
  if (base::isValid(previous_)) addStep(base::secondsBetween(previous_, stamp), clock);
  previous_ = stamp;
}

void StampStatistics::addStep(double step, const StreamClock& clock) {
  if (step <= -kJumpBack) {
    countJump(step, facts_);
  } else if (step < 0) {
    ++facts_.backward;
  } else if (step == 0) {
    ++facts_.repeated;
  } else {
    // If another sensor went on meanwhile, this one paused; a clock that was set was set for all sensors.
    const bool with_all = step >= kJumpAhead && base::isValid(clock.beforePause()) && previous_ <= clock.beforePause();
    (with_all ? leaps_ : steps_).push_back({previous_, static_cast<float>(step)});
  }
}

// The step [s] that the share `part` of all steps is shorter than; 0 without any.
double StampStatistics::stepQuantile(double part) const {
  if (steps_.empty()) return 0;
  std::vector<float> seconds;
  for (const auto& step : steps_) seconds.push_back(step.seconds);
  return quantile(seconds, part);
}

double StampStatistics::period() const {
  return stepQuantile(0.5);
}

// Whether the log was recorded at fixed distances instead of fixed times. Its time steps differ, and there are none
// while the robot rests.
bool StampStatistics::isByDistance() const {
  return stepQuantile(0.9) > kUnevenSteps * period();
}

std::vector<StampStatistics::Step> StampStatistics::pauses() const {
  auto pauses = steps_;
  if (isByDistance()) pauses.insert(pauses.end(), leaps_.begin(), leaps_.end());
  return pauses;
}

StampFacts StampStatistics::facts() const {
  StampFacts facts = facts_;
  setEnds(stamps_, facts);
  if (!isByDistance()) {
    for (const auto& leap : leaps_) countJump(leap.seconds, facts);
  }
  facts.period = period();
  for (const auto& pause : pauses()) facts.longest_gap = std::max<double>(facts.longest_gap, pause.seconds);
  facts.gaps = gaps().size();
  return facts;
}

std::vector<std::pair<base::Stamp, base::Stamp>> StampStatistics::gaps() const {
  std::vector<std::pair<base::Stamp, base::Stamp>> gaps;
  const double usual = period();
  for (const auto& pause : pauses()) {
    if (!isGap(pause.seconds, usual)) continue;
    gaps.emplace_back(pause.begin, pause.begin + base::durationFromSeconds(pause.seconds));
  }
  return gaps;
}

}  // namespace omnimapper::check
