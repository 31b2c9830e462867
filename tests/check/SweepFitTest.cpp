// The time that a laser takes for a scan, from scans of a robot that turns on the spot now and then.
#include <gtest/gtest.h>
#include <omnimapper/testing/FloorPlan.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

#include "SweepFit.h"

namespace omnimapper::check::sweep_fit_test {
namespace {

constexpr double kSeconds = 60, kPeriod = 0.1;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'700'000'000) + base::durationFromSeconds(seconds);
}

/// Turns of half a second to the left and right, with rests between them.
double headingAt(double seconds) {
  constexpr double kCycle = 1.7, kTurn = 0.9, kAngle = 0.8;
  const double cycle = std::floor(seconds / kCycle), share = std::min(1.0, (seconds - cycle * kCycle) / kTurn);
  const bool is_left = static_cast<long>(cycle) % 3 != 1;
  double before = 0;
  for (long i = 0; i < static_cast<long>(cycle); ++i) before += i % 3 != 1 ? kAngle : -kAngle;
  return before + (is_left ? kAngle : -kAngle) * share * share * (3 - 2 * share);
}

ScanPtr scanAt(double seconds, double sweep, testing::Dice& dice) {
  static const auto box = testing::FloorPlan::box();
  constexpr std::size_t kBeams = 271;
  auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>();
  scan->timestamp = at(seconds);
  scan->sensorLabel = "laser";
  scan->aperture = static_cast<float>(1.5 * M_PI);
  scan->maxRange = 30;
  scan->resizeScan(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double share = static_cast<double>(i) / (kBeams - 1);
    const double angle = headingAt(seconds + share * sweep) + scan->aperture * (share - 0.5);
    const double range = box.distanceToWall({0, 0}, {std::cos(angle), std::sin(angle)}) + dice.normal(0.005);
    scan->setScanRange(i, static_cast<float>(range));
    scan->setScanRangeValidity(i, true);
  }
  return scan;
}

std::optional<SweepFacts> fitted(double sweep, double declared, bool has_wheels) {
  testing::Dice dice(11);
  ScanPairs pairs;
  for (double now = 0; now < kSeconds; now += kPeriod) pairs.add(scanAt(now, sweep, dice));
  // The stamp is that of the first beam, the turn that of the middle of the sweep.
  const auto odometry = [&](base::Stamp begin, base::Stamp end) -> std::optional<mrpt::poses::CPose2D> {
    if (!has_wheels) return std::nullopt;
    const double from = base::secondsBetween(at(0), begin) + sweep / 2,
                 to = base::secondsBetween(at(0), end) + sweep / 2;
    return mrpt::poses::CPose2D(0, 0, 1.02 * (headingAt(to) - headingAt(from)));
  };
  return fitSweep(pairs.pairs(), matchPairs(pairs.pairs(), odometry), declared);
}

TEST(Sweep, IsMeasuredWhereTurnsBeginAndEnd) {
  for (const bool has_wheels : {false, true}) {
    for (const double sweep : {0.0, 0.04, 0.09}) {
      const auto fit = fitted(sweep, 0, has_wheels);
      ASSERT_TRUE(fit) << sweep;
      EXPECT_NEAR(fit->sweep, sweep, std::max(0.004, 3 * fit->sigma)) << has_wheels;
      EXPECT_LT(fit->sigma, 0.02);
      EXPECT_EQ(fit->isWrong(), sweep > 0) << sweep << " " << fit->sweep << " +- " << fit->sigma;
    }
  }
}

TEST(Sweep, DeclaredOfAnInstantaneousLaserIsAsWrong) {
  const auto fit = fitted(0, 0.1, true);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->isWrong()) << fit->sweep << " +- " << fit->sigma;
  EXPECT_FALSE(fitted(0.09, 0.09, true)->isWrong());
}

TEST(Sweep, OfARobotThatHardlyTurnsIsNotKnown) {
  ScanPairs pairs;
  testing::Dice dice(2);
  for (int i = 0; i < 100; ++i) {
    auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>(*scanAt(1.5, 0, dice));
    scan->timestamp = at(kPeriod * i);
    pairs.add(scan);
  }
  const auto none = [](base::Stamp, base::Stamp) -> std::optional<mrpt::poses::CPose2D> { return std::nullopt; };
  EXPECT_FALSE(fitSweep(pairs.pairs(), matchPairs(pairs.pairs(), none), 0));
}

}  // namespace
}  // namespace omnimapper::check::sweep_fit_test
