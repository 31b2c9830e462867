// The offset between the clocks of two sensors that measure the same turns.
#include <gtest/gtest.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

#include "ClockFit.h"

namespace omnimapper::check {
namespace {

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'700'000'000) + base::durationFromSeconds(seconds);
}

/// The heading of a robot that turns now and then, as irregular as people drive.
class Drive {
 public:
  explicit Drive(double seconds) {
    testing::Dice dice(3);
    for (double begin = 2; begin < seconds; begin += dice.uniform(4, 9))
      turns_.push_back({begin, dice.uniform(0.5, 1.5), dice.uniform(-1.6, 1.6)});
  }
  double heading(double seconds) const {
    double sum = 0;
    for (const auto& turn : turns_) {
      const double share = std::min(1.0, std::max(0.0, (seconds - turn.begin) / turn.length));
      sum += turn.angle * share * share * (3 - 2 * share);
    }
    return sum;
  }

 private:
  struct Turn {
    double begin, length, angle;
  };
  std::vector<Turn> turns_;
};

constexpr double kSeconds = 200;

/// Turns over half a second each, with errors of 3 mrad.
std::vector<MeasuredTurn> turnsOf(const Drive& drive) {
  testing::Dice dice(5);
  std::vector<MeasuredTurn> turns;
  for (double begin = 0; begin + 0.5 < kSeconds; begin += 1)
    turns.push_back(
        {at(begin), at(begin + 0.5), drive.heading(begin + 0.5) - drive.heading(begin) + dice.normal(0.003)});
  return turns;
}

/// Headings with stamps that are `late` [s] after the moment, and later by `drift` more for each second.
Headings headingsOf(const Drive& drive, double late, double drift = 0, double sign = 1) {
  Headings headings;
  for (int i = 0; i * 0.05 < kSeconds; ++i) {
    const double now = i * 0.05;
    headings.add(at(now * (1 + drift) + late), sign * (drive.heading(now) - drive.heading(now - 0.05)));
  }
  return headings;
}

TEST(Clock, OffsetsFromHundredthsOfASecondToMinutesAreFound) {
  const Drive drive(kSeconds);
  const auto turns = turnsOf(drive);
  for (const double late : {0.0, 0.02, -0.07, 4.3, -80.0}) {
    const auto clock = fitClock(turns, headingsOf(drive, late));
    ASSERT_TRUE(clock) << late;
    EXPECT_NEAR(clock->offset, late, std::max(0.003, 3 * clock->sigma)) << late;
    EXPECT_LT(clock->sigma, 0.005);
    EXPECT_EQ(clock->isWrong(), late != 0 && std::abs(late) > 0.02) << late;
    EXPECT_FALSE(clock->is_reversed);
    EXPECT_EQ(clock->drift, 0);
  }
}

TEST(Clock, ASensorThatTakesLeftForRightIsRecognized) {
  const Drive drive(kSeconds);
  const auto clock = fitClock(turnsOf(drive), headingsOf(drive, 0.3, 0, -1));
  ASSERT_TRUE(clock);
  EXPECT_TRUE(clock->is_reversed);
  EXPECT_NEAR(clock->offset, 0.3, 0.005);
}

TEST(Clock, ADriftIsMeasured) {
  const Drive drive(kSeconds);
  const auto clock = fitClock(turnsOf(drive), headingsOf(drive, 0, 1e-3));
  ASSERT_TRUE(clock);
  EXPECT_NEAR(clock->drift, 1e-3, 1e-4);
}

TEST(Clock, StraightMotionSteadyTurnsAndNoiseSayNothing) {
  std::vector<MeasuredTurn> straight, steady, noise;
  Headings none, turning;
  testing::Dice dice(9);
  for (int i = 0; i < 300; ++i) {
    straight.push_back({at(i), at(i + 0.5), 0});
    steady.push_back({at(i), at(i + 0.5), 0.2});
    noise.push_back({at(i), at(i + 0.5), dice.normal(0.3)});
    none.add(at(0.1 * i), 0);
    turning.add(at(0.1 * i), 0.04);
  }
  EXPECT_FALSE(fitClock(straight, none));
  EXPECT_FALSE(fitClock(steady, turning));
  EXPECT_FALSE(fitClock(noise, headingsOf(Drive(kSeconds), 0)));
  EXPECT_FALSE(fitClock({}, turning));
  EXPECT_FALSE(fitClock(steady, Headings()));
}

TEST(Clock, HeadingsAreNotKnownInPausesAndBeyondTheEnds) {
  Headings headings;
  headings.add(at(0), 0);
  headings.add(at(1), 0.5);
  headings.add(at(4), 1);  // three seconds without a reading
  headings.add(at(5), 0.25);
  EXPECT_NEAR(headings.turn(at(0.2), at(0.8)), 0.3, 1e-9);
  EXPECT_TRUE(std::isnan(headings.turn(at(0.5), at(2))));
  EXPECT_TRUE(std::isnan(headings.turn(at(4.5), at(6))));
  EXPECT_NEAR(headings.turn(at(4.2), at(4.6)), 0.1, 1e-9);
}

TEST(ClockOffsets, ThatLaserOdometryMayCorrectItselfAreNotProposed) {
  LogFacts facts;
  auto& scans = facts.scans["laser"];
  scans.scans = 100;
  scans.valid_share = 1;
  scans.aperture = 3;
  MotionFacts motion;
  motion.laser = "laser";
  motion.odometry = "wheels";
  motion.clock = ClockFacts{0.335, 0.032, 0, false};  // of a drive of a minute, whose true offset is 0.1 s
  facts.motions = {motion};
  EXPECT_TRUE(clockOffsets(facts).empty());
  facts.motions.front().clock->sigma = 0.01;
  EXPECT_EQ(clockOffsets(facts).count("wheels"), 1U);
}

}  // namespace
}  // namespace omnimapper::check
