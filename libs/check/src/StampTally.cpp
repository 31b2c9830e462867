#include "StampTally.h"

#include <algorithm>

#include "Quantile.h"

namespace omnimapper::check {

namespace {
constexpr double kJumpAhead = 60;    // [s]
constexpr double kGapOfPeriods = 5;  // and of a second at least

// One stamp gone wrong must not make the log a year long: what is far from nearly all others is left out.
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
}  // namespace

void StampTally::add(base::Stamp stamp, base::Stamp newest) {
  ++facts_.count;
  if (!base::isValid(stamp)) {
    ++facts_.no_stamp;
    return;
  }
  stamps_.push_back(stamp);
  if (base::isValid(newest)) {
    const double late = base::secondsBetween(stamp, newest);
    if (late < kJumpBack) facts_.lateness = std::max(facts_.lateness, late);
  }
  if (base::isValid(previous_)) addStep(base::secondsBetween(previous_, stamp));
  previous_ = stamp;
}

void StampTally::addStep(double step) {
  if (step >= kJumpAhead || step <= -kJumpBack) {
    ++facts_.jumps;
    if (std::abs(step) > std::abs(facts_.largest_jump)) facts_.largest_jump = step;
  } else if (step < 0) {
    ++facts_.backward;
  } else if (step == 0) {
    ++facts_.repeated;
  } else {
    steps_.push_back(static_cast<float>(step));
  }
}

StampFacts StampTally::facts() const {
  StampFacts facts = facts_;
  setEnds(stamps_, facts);
  if (steps_.empty()) return facts;
  facts.period = quantile(steps_, 0.5);
  for (const double step : steps_) {
    facts.longest_gap = std::max(facts.longest_gap, step);
    if (step >= std::max(1.0, kGapOfPeriods * facts.period)) ++facts.gaps;
  }
  return facts;
}

}  // namespace omnimapper::check
