#include <gtest/gtest.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/matching/ScanTracker.h>

#include "Scans.h"

namespace omnimapper::matching::scan_tracker_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;

constexpr double kDegree = 3.14159265358979323846 / 180;

ScanTracker makeTracker(const ScanTrackerOptions& options = {}) {
  return {options, makeMatcher({})};
}

const Eigen::Vector2f kOrigin(0, 0);

MotionPrediction predicted(const TPose2D& motion) {
  return {motion, 0.1, 0.1};
}

// Along the first straight of the ring and into it, a step every 7 cm and 0.6 degrees.
TPose2D pathAt(int step) {
  return {-3 + 0.07 * step, 0.002 * step, 0.01 * step - 0.3};
}

TEST(ScanTracker, FollowsAPathWithGuessesThatAreAlwaysTooShort) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  tracker.restart(scanFrom(plan, pathAt(0), 0.01, 0), kOrigin);
  TPose2D start_from_last;
  constexpr int kSteps = 80;
  for (int i = 1; i <= kSteps; ++i) {
    const TPose2D motion = pathAt(i) - pathAt(i - 1);
    const auto match = tracker.track(scanFrom(plan, pathAt(i), 0.01, i), kOrigin, {predicted({0.5 * motion.x, 0, 0})});
    ASSERT_TRUE(match) << "step " << i;
    start_from_last = start_from_last + match->match.reference_from_scan;
  }
  const auto error = start_from_last - (pathAt(kSteps) - pathAt(0));
  EXPECT_LT(std::hypot(error.x, error.y), 0.03) << "over 5.6 m";
  EXPECT_LT(std::abs(error.phi), 0.5 * kDegree);
}

TEST(ScanTracker, TakesTheNextGuessWhereOneLeadsNowhere) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  const auto scan = scanFrom(plan, pathAt(1));
  const TPose2D nonsense(40, 40, 2), truth = pathAt(1) - pathAt(0);
  EXPECT_FALSE(tracker.track(scan, kOrigin, {predicted(nonsense)}));
  EXPECT_FALSE(tracker.track(scan, kOrigin, {}));
  EXPECT_FALSE(tracker.track({}, kOrigin, {predicted(truth)})) << "a scan without points";
  const auto match = tracker.track(scan, kOrigin, {predicted(nonsense), predicted(truth)});
  ASSERT_TRUE(match) << "what failed before changed nothing";
  EXPECT_EQ(match->prediction, 1U);
  EXPECT_LT(std::abs(match->match.reference_from_scan.x - truth.x), 0.01);
}

// The most trusted prediction is 26 deg and 0.3 m off.
TEST(ScanTracker, TakesTheMoreProbableOfTwoMatches) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  const TPose2D truth = pathAt(1) - pathAt(0);
  const auto match = tracker.track(scanFrom(plan, pathAt(1)), kOrigin,
                                   {{TPose2D(0.1, 0.3, 26 * kDegree), 0.2, 20 * kDegree}, {truth, 0.2, 0.2}});
  ASSERT_TRUE(match);
  EXPECT_LT(std::hypot(match->match.reference_from_scan.x - truth.x, match->match.reference_from_scan.y - truth.y),
            0.01);
}

// Every prediction is off by more than a match can correct, so all headings are searched.
TEST(ScanTracker, SearchesWhereNoPredictionFits) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  const TPose2D truth(0.2, 0.1, 100 * kDegree), wrong(0, 0, 30 * kDegree);
  const auto match = tracker.track(scanFrom(plan, pathAt(0) + truth), kOrigin, {{wrong, 0.1, 25 * kDegree}});
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->match.reference_from_scan.phi, truth.phi, kDegree);
  EXPECT_NEAR(match->match.reference_from_scan.x, truth.x, 0.02);
}

// A match farther away than anything on wheels gets in the time is refused, however well it fits.
TEST(ScanTracker, WhatIsImpossibleIsNoMatch) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  const auto scan = scanFrom(plan, pathAt(4));
  EXPECT_TRUE(tracker.track(scan, kOrigin, {{TPose2D(), 0.1, 0.1}})) << "0.28 m";
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  EXPECT_FALSE(tracker.track(scan, kOrigin, {{TPose2D(), 0.01, 0.01, 0.1, 0.2}}));
  EXPECT_FALSE(tracker.track(scan, kOrigin, {{TPose2D(), 0.2, 0.1, 0.1, 0.2}})) << "however far off predictions were";
}

TEST(ScanTracker, MatchesBeyondItsLimitsAreRefused) {
  const auto plan = FloorPlan::ring();
  ScanTrackerOptions strict;
  strict.max_correction = 0.05;
  auto tracker = makeTracker(strict);
  EXPECT_FALSE(tracker.track(scanFrom(plan, pathAt(0)), kOrigin, {predicted({})})) << "before the first scan";
  tracker.restart(scanFrom(plan, pathAt(0)), kOrigin);
  EXPECT_FALSE(tracker.track(scanFrom(plan, pathAt(3)), kOrigin, {predicted({})})) << "20 cm from the guess";
  EXPECT_TRUE(tracker.track(scanFrom(plan, pathAt(3)), kOrigin, {predicted(pathAt(3) - pathAt(0))}));
}

// The guess determines the motion along the corridor, the walls that across.
TEST(ScanTracker, AlongABareCorridorTheGuessCounts) {
  FloorPlan corridor;
  corridor.addPolygon({{-90, -1.5}, {90, -1.5}, {90, 1.5}, {-90, 1.5}});
  auto tracker = makeTracker();
  tracker.restart(scanFrom(corridor, {0, 0, 0}, 0.005, 1, 8), kOrigin);
  TPose2D start_from_last;
  for (int i = 1; i <= 30; ++i) {
    const MatchGuess guess{TPose2D(0.1, 0.02, 0), Eigen::Vector3d(1, 1, 1).asDiagonal()};
    const auto match =
        tracker.track(scanFrom(corridor, {0.1 * i, 0, 0}, 0.005, i + 1, 8), kOrigin, {{guess, 0.1, 0.1}});
    ASSERT_TRUE(match);
    EXPECT_TRUE(match->match.degenerate);
    start_from_last = start_from_last + match->match.reference_from_scan;
  }
  EXPECT_NEAR(start_from_last.x, 3, 0.05);
  EXPECT_NEAR(start_from_last.y, 0, 0.02);
}

}  // namespace
}  // namespace omnimapper::matching::scan_tracker_test
