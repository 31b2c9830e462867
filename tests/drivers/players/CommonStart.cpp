#include "CommonStart.h"

#include <omnimapper/live/HostClock.h>

namespace omnimapper::players {

namespace {

constexpr double kBeforeStart = 0.1;  // [s] in which all players, which poll every 10 or 20 ms, learn the start

}  // namespace

CommonStart::CommonStart(int players, base::Stamp log_start, double pace, std::optional<base::Stamp> host_start)
    : log_start_(log_start), pace_(pace), awaited_(players), host_start_(host_start) {}

void CommonStart::ready() {
  const std::lock_guard lock(mutex_);
  if (--awaited_ == 0 && !host_start_) host_start_ = live::hostNow() + base::durationFromSeconds(kBeforeStart);
}

std::optional<PlayClock> CommonStart::clock() const {
  const std::lock_guard lock(mutex_);
  if (!host_start_) return std::nullopt;
  return PlayClock(log_start_, *host_start_, pace_);
}

}  // namespace omnimapper::players
