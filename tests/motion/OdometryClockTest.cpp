#include <gtest/gtest.h>
#include <omnimapper/motion/OdometryClock.h>

#include <cmath>
#include <random>

namespace omnimapper::motion::odometry_clock_test {
namespace {

// The heading of a base that turns back and forth, each time a little faster, and rests in between.
double headingAt(double seconds) {
  return 2 * std::sin(0.7 * seconds) * std::sin(0.13 * seconds);
}

base::Stamp stampAt(double seconds) {
  return base::Stamp{} + base::durationFromSeconds(1000 + seconds);
}

struct Drive {
  double offset = 0;     // [s] of the odometry's stamps
  double scale = 1;      // of the turns that it measures
  double noise = 0;      // [rad] of each turn that scans measure
  double seconds = 120;  // of the drive
  double turning = 1;    // share of the turns
};

double offsetOf(const Drive& drive) {
  std::mt19937 generator(3);
  std::normal_distribution<double> gaussian;
  OdometryClock clock;
  double matched_until = 0;
  const auto heading = [&](double seconds) { return drive.turning * headingAt(seconds); };
  for (int i = 0; i * OdometryClock::kStep < drive.seconds; ++i) {
    const double now = i * OdometryClock::kStep, moment = now - drive.offset;
    clock.addTurn(stampAt(now), drive.scale * (heading(moment) - heading(moment - OdometryClock::kStep)));
    if (now < matched_until + 0.4) continue;
    clock.addMatch(stampAt(matched_until), stampAt(matched_until + 0.4),
                   heading(matched_until + 0.4) - heading(matched_until) + drive.noise * gaussian(generator));
    matched_until += 0.4;
  }
  return clock.offset();
}

TEST(OdometryClock, FindsTheOffsetOfTheStamps) {
  for (const double offset : {-0.4, -0.1, 0.07, 0.3}) {
    EXPECT_NEAR(offsetOf({offset}), offset, 0.01);
    EXPECT_NEAR(offsetOf({offset, 1.04, 0.01}), offset, 0.02) << "wheels that turn 4 % too far, scans with noise";
  }
}

TEST(OdometryClock, ThereIsNoOffsetWithoutEvidence) {
  EXPECT_EQ(offsetOf({0}), 0);
  EXPECT_EQ(offsetOf({0, 1.04, 0.01}), 0);
  EXPECT_EQ(offsetOf({0.2, 1, 0.2}), 0) << "noise hides it";
  Drive straight{0.2, 1, 0.001};
  straight.turning = 0;
  EXPECT_EQ(offsetOf(straight), 0);
  EXPECT_EQ(offsetOf({0.2, 1, 0, 4}), 0) << "too few turns";
  EXPECT_EQ(offsetOf({0.9}), 0) << "beyond what is searched";
}

TEST(OdometryClock, AGapInTheOdometryIsNotBridged) {
  OdometryClock clock;
  clock.addTurn(stampAt(0), 0);
  clock.addTurn(stampAt(0.05), 0.1);
  clock.addMatch(stampAt(0), stampAt(5), 3);
  clock.addTurn(stampAt(9), 3);
  EXPECT_EQ(clock.end(), stampAt(9));
  EXPECT_EQ(clock.offset(), 0);
}

}  // namespace
}  // namespace omnimapper::motion::odometry_clock_test
