#include "PlayClock.h"

#include <omnimapper/eval/TumFile.h>
#include <omnimapper/live/HostClock.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace omnimapper::players {

PlayClock::PlayClock(base::Stamp log_start, base::Stamp host_start, double pace)
    : log_start_(log_start), host_start_(host_start), pace_(pace) {}

base::Stamp PlayClock::hostTime(base::Stamp log) const {
  const auto ticks = static_cast<double>((log - log_start_).count()) / pace_;
  return host_start_ + base::Duration(std::llround(ticks));
}

bool waitUntil(base::Stamp host, const Stop& stop) {
  for (;;) {
    const double left = base::secondsBetween(live::hostNow(), host);
    if (stop()) return false;
    if (left <= 0) return true;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.02)));
  }
}

void shiftTrajectory(const std::string& from, const std::string& to, const PlayClock& clock) {
  auto trajectory = eval::readTrajectory(from);
  for (auto& pose : trajectory) pose.stamp = clock.hostTime(pose.stamp);
  eval::writeTum(to, trajectory);
}

}  // namespace omnimapper::players
