#include <gtest/gtest.h>
#include <omnimapper/live/SensorClock.h>

#include "Observations.h"

namespace omnimapper::live::sensor_clock_test {
namespace {

using namespace observations;
using Clock = SensorOptions::Clock;

constexpr double kMaxOff = 0.5;

double secondsOf(base::Stamp stamp) {
  return base::secondsBetween(kNow, stamp);
}

TEST(SensorClock, stampsThatAreNearTheirArrivalStay) {
  SensorClock clock({}, kMaxOff);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(secondsOf(clock.corrected(at(i), at(i + 0.05 + 0.001 * (i % 7)))), i, 1e-6);
  EXPECT_EQ(clock.jumps(), 0u);
  EXPECT_EQ(clock.offset(), 0);
}

TEST(SensorClock, anObservationWithoutStampHasThatOfItsArrival) {
  SensorClock clock({}, kMaxOff);
  EXPECT_EQ(clock.corrected(base::Stamp{}, at(3)), at(3));
}

// The device's clock counts from its start. The shortest of ten latencies is 5 ms and is assumed to be zero.
TEST(SensorClock, anotherClockIsMovedByTheShortestLatency) {
  SensorClock clock({}, kMaxOff);
  double last = 0;
  for (int i = 0; i < 1000; ++i) {
    const double latency = i % 10 == 0 ? 0.005 : 0.030;
    last = secondsOf(clock.corrected(at(-5e7 + i), at(i + latency)));
  }
  EXPECT_NEAR(last, 999.005, 0.002);
  EXPECT_EQ(clock.jumps(), 1u);
  EXPECT_NEAR(clock.offset(), 5e7 + 0.005, 0.002);
}

TEST(SensorClock, aClockThatJumpsIsFoundAgain) {
  SensorClock clock({}, kMaxOff);
  for (int i = 0; i < 50; ++i) clock.corrected(at(i), at(i + 0.01));
  EXPECT_NEAR(secondsOf(clock.corrected(at(1050), at(50.01))), 50.01, 1e-6) << "from the future: at once";
  EXPECT_EQ(clock.jumps(), 1u);
  double last = 0;
  for (int i = 51; i < 80; ++i) last = secondsOf(clock.corrected(at(i - 2), at(i + 0.01)));
  EXPECT_NEAR(last, 79.01, 0.01) << "back by two seconds against the host: after ten";
}

TEST(SensorClock, aBurstThatWasHeldUpIsNoJump) {
  SensorClock clock({}, kMaxOff);
  for (int i = 0; i < 50; ++i) clock.corrected(at(i), at(i + 0.01));
  for (int i = 50; i < 55; ++i) EXPECT_NEAR(secondsOf(clock.corrected(at(i), at(56))), i, 1e-6);
  for (int i = 57; i < 70; ++i) EXPECT_NEAR(secondsOf(clock.corrected(at(i), at(i + 0.01))), i, 1e-6);
  EXPECT_EQ(clock.jumps(), 0u);
}

// A machine that is busy for four seconds receives all images late.
TEST(SensorClock, aBusyMachineIsNoJump) {
  SensorClock clock({}, kMaxOff);
  for (int i = 0; i < 300; ++i) {
    const double stamp = 0.1 * i, latency = i >= 100 && i < 140 ? 0.7 : 0.01;
    EXPECT_NEAR(secondsOf(clock.corrected(at(stamp), at(stamp + latency))), stamp, 1e-6);
  }
  EXPECT_EQ(clock.jumps(), 0u);
}

// A machine that is busy for a minute receives all images late, but their latencies vary.
TEST(SensorClock, aMachineThatIsTooBusyIsNoJump) {
  SensorClock clock({}, kMaxOff);
  for (int i = 0; i < 1000; ++i) {
    const double stamp = 0.1 * i, latency = i >= 100 && i < 700 ? 0.6 + 0.08 * (i % 20) : 0.01;
    EXPECT_NEAR(secondsOf(clock.corrected(at(stamp), at(stamp + latency))), stamp, 1e-6);
  }
  EXPECT_EQ(clock.jumps(), 0u);
}

TEST(SensorClock, aClockThatIsBehindFromTheStartIsFoundAfterTen) {
  SensorClock clock({}, kMaxOff);
  double last = 0;
  for (int i = 0; i < 11; ++i) last = secondsOf(clock.corrected(at(0.1 * i - 2), at(0.1 * i)));
  EXPECT_NEAR(last, 1.0, 1e-3);
  EXPECT_EQ(clock.jumps(), 1u);
}

TEST(SensorClock, doesAsItsOptionsSay) {
  SensorOptions options;
  options.clock = Clock::arrival;
  SensorClock by_arrival(options, kMaxOff);
  EXPECT_EQ(by_arrival.corrected(at(-100), at(3)), at(3));
  EXPECT_GT(by_arrival.corrected(at(-100), at(3)), at(3))
      << "two observations that arrive at once have different stamps";
  EXPECT_EQ(by_arrival.corrected(at(-100), at(4)), at(4));
  options.clock = Clock::driver;
  options.clock_offset = -0.25;
  EXPECT_NEAR(secondsOf(SensorClock(options, kMaxOff).corrected(at(-100), at(3))), -100.25, 1e-6);
}

}  // namespace
}  // namespace omnimapper::live::sensor_clock_test
