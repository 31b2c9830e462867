#include "hokuyo/LaserClock.h"

#include <algorithm>
#include <chrono>

namespace omnimapper::drivers {

namespace {

using std::chrono::milliseconds;

constexpr std::uint32_t kLastDeviceTime = (1U << 24) - 1;
constexpr int kFirstMessages = 10;  // latencies vary among these
constexpr auto kWindow = std::chrono::seconds(10);
constexpr auto kLargestStep = milliseconds(2);  // of a window: 200 ppm, twice the drift of the worst quartz
// A larger error than these is no drift but a restart of the laser. No latency makes a stamp too early, so 20 ms, ten
// times the largest step, are enough; a busy machine may read a whole window late, so the other direction needs 100 ms.
constexpr auto kRestartedLate = milliseconds(100), kRestartedEarly = milliseconds(20);
constexpr auto kNewer = milliseconds(1);

}  // namespace

base::Stamp LaserClock::stampOf(std::uint32_t device_ms, base::Stamp arrival) {
  if (messages_ == 0) {
    expected_ = last_ = since_ = arrival;
    last_ -= kNewer;
  } else {
    expected_ += milliseconds((device_ms - device_ms_) & kLastDeviceTime);
  }
  device_ms_ = device_ms & kLastDeviceTime;
  ++messages_;
  correctDrift(arrival - expected_, arrival);
  last_ = std::max(expected_, last_ + kNewer);
  return last_;
}

void LaserClock::correctDrift(base::Duration lag, base::Stamp arrival) {
  if (lag < -kRestartedEarly || (messages_ <= kFirstMessages && lag < base::Duration::zero())) {
    expected_ = since_ = arrival;
    shortest_lag_ = base::Duration::max();
    return;
  }
  if (messages_ == 1) shortest_lag_ = base::Duration::max();
  shortest_lag_ = std::min(shortest_lag_, lag);
  if (arrival - since_ < kWindow) return;
  expected_ += shortest_lag_ > kRestartedLate ? shortest_lag_
                                              : std::clamp<base::Duration>(shortest_lag_, -kLargestStep, kLargestStep);
  shortest_lag_ = base::Duration::max();
  since_ = arrival;
}

}  // namespace omnimapper::drivers
