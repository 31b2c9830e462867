#include <gtest/gtest.h>
#include <hokuyo/LaserClock.h>

#include <cmath>

#include "../live/Observations.h"

namespace omnimapper::drivers::laser_clock_test {
namespace {

using live::observations::at;

/// The largest error [s] of stamps after the first minute; messages come at 40 Hz for `hours`, each up to 20 ms late,
/// from a clock that is fast by `drift` and shows `first_ms` at the start.
double largestError(double hours, double drift, std::uint32_t first_ms) {
  LaserClock clock;
  double largest = 0;
  base::Stamp before;
  const int count = static_cast<int>(hours * 3600 * 40);
  for (int i = 0; i < count; ++i) {
    const double time = i / 40.0, latency = 0.001 * (i * 7 % 21);
    const auto device_ms = static_cast<std::uint32_t>(first_ms + std::llround(1000 * time * (1 + drift)));
    const auto stamp = clock.stampOf(device_ms & 0xffffff, at(time + latency));
    EXPECT_GT(stamp, before);
    before = stamp;
    if (time > 60) largest = std::max(largest, std::abs(base::secondsBetween(at(time), stamp)));
  }
  return largest;
}

TEST(LaserClock, stampsAreThoseOfTheMeasurementWithoutTheLatency) {
  EXPECT_LT(largestError(0.2, 0, 1000), 0.0025);
}

TEST(LaserClock, aClockThatIsFastOrSlowIsFollowed) {
  EXPECT_LT(largestError(1, 1e-4, 1000), 0.005);
  EXPECT_LT(largestError(1, -1e-4, 1000), 0.005);
}

TEST(LaserClock, aCountThatBeginsAnewIsNoJump) {
  EXPECT_LT(largestError(0.1, 0, (1U << 24) - 200'000), 0.0025);
}

TEST(LaserClock, aLaserThatWasSwitchedOffAndOnIsFoundAgain) {
  LaserClock clock;
  for (int i = 0; i < 100; ++i) clock.stampOf(static_cast<std::uint32_t>(5'000'000 + 25 * i), at(0.025 * i));
  for (int i = 0; i < 100; ++i) {
    const auto stamp = clock.stampOf(static_cast<std::uint32_t>(25 * i), at(10 + 0.025 * i));
    EXPECT_NEAR(base::secondsBetween(at(10 + 0.025 * i), stamp), 0, 0.002) << i;
  }
}

}  // namespace
}  // namespace omnimapper::drivers::laser_clock_test
