#include <omnimapper/live/SensorClock.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::live {

base::Stamp SensorClock::corrected(base::Stamp stamp, base::Stamp arrival) {
  if (options_.clock == SensorOptions::Clock::arrival || !base::isValid(stamp)) return arrival;
  const base::Stamp told = stamp + base::durationFromSeconds(options_.clock_offset);
  if (options_.clock == SensorOptions::Clock::driver) return told;
  constexpr std::size_t kRemembered = 10;
  constexpr double kDrift = 1e-4;  // of a quartz, at most
  const double off = base::secondsBetween(told, arrival);
  newest_.push_back(off);
  if (newest_.size() > kRemembered) newest_.pop_front();
  if (hasJumped(off)) {
    ++jumps_;
    newest_.assign(1, off);
    offset_ = std::abs(off) <= max_off_ ? 0 : off;
  } else if (offset_ != 0) {
    offset_ = std::min(offset_ + kDrift * base::secondsBetween(last_arrival_, arrival), off);
  }
  last_arrival_ = arrival;
  return told + base::durationFromSeconds(offset_);
}

// What comes from the future, or a minute late, is by another clock at once. What comes a little late may have been
// held up on its way, unless it is all late.
bool SensorClock::hasJumped(double off) const {
  constexpr double kNoLatency = 60;  // [s]
  constexpr std::size_t kMany = 10;
  const double late = off - offset_;
  if (late < -max_off_ || late > kNoLatency) return true;
  return newest_.size() >= kMany && *std::min_element(newest_.begin(), newest_.end()) - offset_ > max_off_;
}

}  // namespace omnimapper::live
