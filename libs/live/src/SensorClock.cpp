#include <omnimapper/live/SensorClock.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::live {

namespace {

constexpr std::size_t kMany = 10;  // observations
constexpr double kLong = 5;        // [s]

}  // namespace

base::Stamp SensorClock::corrected(base::Stamp stamp, base::Stamp arrival) {
  if (options_.clock == SensorOptions::Clock::arrival || !base::isValid(stamp)) {
    // Observations that are read at once get different stamps, because two with the same stamp would count as one.
    last_given_ = std::max(arrival, last_given_ + base::Duration(1));
    return last_given_;
  }
  const base::Stamp reported = stamp + base::durationFromSeconds(options_.clock_offset);
  if (options_.clock == SensorOptions::Clock::driver) return reported;
  constexpr double kDrift = 1e-4;  // largest drift of a quartz
  const double off = base::secondsBetween(reported, arrival);
  newest_.push_back({arrival, off});
  while (newest_.size() > kMany && base::secondsBetween(newest_[1].arrival, arrival) >= kLong) newest_.pop_front();
  if (hasJumped(off)) {
    ++jumps_;
    newest_.assign(1, {arrival, off});
    offset_ = std::abs(off) <= max_off_ ? 0 : off;
  } else if (offset_ != 0) {
    offset_ = std::min(offset_ + kDrift * base::secondsBetween(last_arrival_, arrival), off);
  }
  is_new_ = is_new_ && newest_.size() < kMany;
  last_arrival_ = arrival;
  return reported + base::durationFromSeconds(offset_);
}

// A stamp from the future, or a minute late, is by another clock, which is decided at once. A stamp that is a little
// late may belong to an observation that was held up, on a busy machine for many seconds, but then the delay varies.
// With another clock all stamps are late by the same time.
bool SensorClock::hasJumped(double off) const {
  constexpr double kNoLatency = 60;  // [s]
  const double late = off - offset_;
  if (late < -max_off_ || late > kNoLatency) return true;
  const bool is_new = is_new_ && newest_.size() == kMany;
  if (!is_new && base::secondsBetween(newest_.front().arrival, newest_.back().arrival) < kLong) return false;
  const auto [least, most] =
      std::minmax_element(newest_.begin(), newest_.end(), [](const auto& a, const auto& b) { return a.off < b.off; });
  return newest_.size() >= kMany && least->off - offset_ > max_off_ && most->off - least->off < max_off_;
}

}  // namespace omnimapper::live
