#include <gtest/gtest.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/matching/ScanTracker.h>
#include <omnimapper/matching/Things.h>

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

void restart(ScanTracker& tracker, const ScanWithNormals& scan) {
  tracker.restart(scan, kOrigin, 0);
}

std::optional<ScanTracker::Tracked> track(ScanTracker& tracker, const ScanWithNormals& scan,
                                          const std::vector<MotionPrediction>& predictions) {
  return tracker.track(scan, kOrigin, predictions, 0.1);
}

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
  restart(tracker, scanFrom(plan, pathAt(0), 0.01, 0));
  TPose2D start_from_last;
  constexpr int kSteps = 80;
  for (int i = 1; i <= kSteps; ++i) {
    const TPose2D motion = pathAt(i) - pathAt(i - 1);
    const auto match = track(tracker, scanFrom(plan, pathAt(i), 0.01, i), {predicted({0.5 * motion.x, 0, 0})});
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
  restart(tracker, scanFrom(plan, pathAt(0)));
  const auto scan = scanFrom(plan, pathAt(1));
  const TPose2D nonsense(40, 40, 2), truth = pathAt(1) - pathAt(0);
  EXPECT_FALSE(track(tracker, scan, {predicted(nonsense)}));
  EXPECT_FALSE(track(tracker, scan, {}));
  EXPECT_FALSE(track(tracker, {}, {predicted(truth)})) << "a scan without points";
  const auto match = track(tracker, scan, {predicted(nonsense), predicted(truth)});
  ASSERT_TRUE(match) << "what failed before changed nothing";
  EXPECT_EQ(match->prediction, 1U);
  EXPECT_LT(std::abs(match->match.reference_from_scan.x - truth.x), 0.01);
}

// The most trusted prediction is 26 deg and 0.3 m off.
TEST(ScanTracker, TakesTheMoreProbableOfTwoMatches) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  restart(tracker, scanFrom(plan, pathAt(0)));
  const TPose2D truth = pathAt(1) - pathAt(0);
  const auto match = track(tracker, scanFrom(plan, pathAt(1)),
                           {{TPose2D(0.1, 0.3, 26 * kDegree), 0.2, 20 * kDegree}, {truth, 0.2, 0.2}});
  ASSERT_TRUE(match);
  EXPECT_LT(std::hypot(match->match.reference_from_scan.x - truth.x, match->match.reference_from_scan.y - truth.y),
            0.01);
}

// Every prediction is off by more than a match can correct, so all headings are searched.
TEST(ScanTracker, SearchesWhereNoPredictionFits) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  restart(tracker, scanFrom(plan, pathAt(0)));
  const TPose2D truth(0.2, 0.1, 100 * kDegree), wrong(0, 0, 30 * kDegree);
  const auto match = track(tracker, scanFrom(plan, pathAt(0) + truth), {{wrong, 0.1, 25 * kDegree}});
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->match.reference_from_scan.phi, truth.phi, kDegree);
  EXPECT_NEAR(match->match.reference_from_scan.x, truth.x, 0.02);
}

// A match farther away than anything on wheels gets in the time is refused, however well it fits.
TEST(ScanTracker, WhatIsImpossibleIsNoMatch) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  restart(tracker, scanFrom(plan, pathAt(0)));
  const auto scan = scanFrom(plan, pathAt(4));
  EXPECT_TRUE(track(tracker, scan, {{TPose2D(), 0.1, 0.1}})) << "0.28 m";
  restart(tracker, scanFrom(plan, pathAt(0)));
  EXPECT_FALSE(track(tracker, scan, {{TPose2D(), 0.01, 0.01, 0.1, 0.2}}));
  EXPECT_FALSE(track(tracker, scan, {{TPose2D(), 0.2, 0.1, 0.1, 0.2}})) << "however far off predictions were";
}

TEST(ScanTracker, MatchesBeyondItsLimitsAreRefused) {
  const auto plan = FloorPlan::ring();
  ScanTrackerOptions strict;
  strict.max_correction = 0.05;
  auto tracker = makeTracker(strict);
  EXPECT_FALSE(track(tracker, scanFrom(plan, pathAt(0)), {predicted({})})) << "before the first scan";
  restart(tracker, scanFrom(plan, pathAt(0)));
  EXPECT_FALSE(track(tracker, scanFrom(plan, pathAt(3)), {predicted({})})) << "20 cm from the guess";
  EXPECT_TRUE(track(tracker, scanFrom(plan, pathAt(3)), {predicted(pathAt(3) - pathAt(0))}));
}

// The guess determines the motion along the corridor, the walls that across.
TEST(ScanTracker, AlongABareCorridorTheGuessCounts) {
  FloorPlan corridor;
  corridor.addPolygon({{-90, -1.5}, {90, -1.5}, {90, 1.5}, {-90, 1.5}});
  auto tracker = makeTracker();
  restart(tracker, scanFrom(corridor, {0, 0, 0}, 0.005, 1, 8));
  TPose2D start_from_last;
  for (int i = 1; i <= 30; ++i) {
    const MatchGuess guess{TPose2D(0.1, 0.02, 0), Eigen::Vector3d(1, 1, 1).asDiagonal()};
    const auto match = track(tracker, scanFrom(corridor, {0.1 * i, 0, 0}, 0.005, i + 1, 8), {{guess, 0.1, 0.1}});
    ASSERT_TRUE(match);
    EXPECT_TRUE(match->match.degenerate);
    start_from_last = start_from_last + match->match.reference_from_scan;
  }
  EXPECT_NEAR(start_from_last.x, 3, 0.05);
  EXPECT_NEAR(start_from_last.y, 0, 0.02);
}

// The scan of a corridor without ends, in which the two legs of a person stand or walk `ahead` [m] of the laser.
ScanWithNormals scanBehindPerson(double x, double ahead, std::uint64_t seed) {
  FloorPlan plan;
  plan.addPolygon({{-90, -1.5}, {90, -1.5}, {90, 1.5}, {-90, 1.5}});
  for (const double y : {-0.2, 0.1}) {
    const double near = x + ahead;
    plan.addPolygon({{near, y}, {near, y + 0.12}, {near + 0.12, y + 0.12}, {near + 0.12, y}});
  }
  auto scan = scanFrom(plan, {x, 0, 0}, 0.005, seed, 8);
  scan.things = numberThings(scan.points, kOrigin, rangeNoise(scan.points));
  return scan;
}

MeasuredMotion byWheels(double x) {
  return {TPose2D(x, 0, 0), Eigen::Vector3d(2.5e-5, 2.5e-5, 1e-5).asDiagonal()};
}

// Nothing but the person shows the motion along the corridor, and by the person there is none.
TEST(ScanTracker, WhoWalksAheadDoesNotHoldTheRobotBack) {
  auto tracker = makeTracker();
  tracker.restart(scanBehindPerson(0, 1, 1), kOrigin, 0);
  TPose2D start_from_last;
  std::size_t moving = 0;
  for (int i = 1; i <= 100; ++i) {
    const auto tracked = tracker.track(scanBehindPerson(0.05 * i, 1, i + 1), kOrigin,
                                       {predicted({0.05, 0, 0}), predicted({0, 0, 0})}, 0.1 * i, byWheels(0.05));
    ASSERT_TRUE(tracked) << i;
    start_from_last = start_from_last + tracked->match.reference_from_scan;
    if (i > 20) moving += !tracked->moving.empty();
  }
  EXPECT_NEAR(start_from_last.x, 5, 0.1);
  EXPECT_NEAR(start_from_last.y, 0, 0.02);
  EXPECT_GE(moving, 75U) << "of 80 scans";
}

// Things that stand are as good as walls once they were seen to: wheels that report too little are corrected by them.
TEST(ScanTracker, ThingsThatStandCount) {
  FloorPlan plan;
  plan.addPolygon({{-90, -1.5}, {90, -1.5}, {90, 1.5}, {-90, 1.5}});
  for (double x = 1; x < 12; x += 1.5) {
    for (const double y : {-1.2, 0.8}) plan.addPolygon({{x, y}, {x, y + 0.4}, {x + 0.4, y + 0.4}, {x + 0.4, y}});
  }
  auto tracker = makeTracker();
  const auto scanAt = [&](int i) {
    auto scan = scanFrom(plan, {0.05 * i, 0, 0}, 0.005, static_cast<std::uint64_t>(i) + 1, 8);
    scan.things = numberThings(scan.points, kOrigin, rangeNoise(scan.points));
    return scan;
  };
  tracker.restart(scanAt(0), kOrigin, 0);
  TPose2D start_from_last;
  for (int i = 1; i <= 100; ++i) {
    const auto tracked = tracker.track(scanAt(i), kOrigin, {predicted({0.047, 0, 0})}, 0.1 * i, byWheels(0.047));
    ASSERT_TRUE(tracked) << i;
    start_from_last = start_from_last + tracked->match.reference_from_scan;
    EXPECT_TRUE(tracked->moving.empty()) << i;
  }
  EXPECT_NEAR(start_from_last.x, 5, 0.12) << "by the wheels alone it is 4.7";
}

TEST(ScanTracker, WheelsThatSlipAreOverruledByWalls) {
  const auto plan = FloorPlan::ring();
  auto tracker = makeTracker();
  restart(tracker, scanFrom(plan, pathAt(0), 0.005));
  const TPose2D truth = pathAt(1) - pathAt(0);
  const auto tracked = tracker.track(scanFrom(plan, pathAt(1), 0.005, 2), kOrigin, {predicted({0.3, 0, 0.1})}, 0.1,
                                     MeasuredMotion{TPose2D(0.3, 0, 0.1), 1e-5 * Eigen::Matrix3d::Identity()});
  ASSERT_TRUE(tracked);
  EXPECT_TRUE(tracked->is_determined);
  EXPECT_NEAR(std::sqrt(tracked->search_covariance(0, 0)), 0.23, 0.02) << "what is right is not known";
  EXPECT_LT(std::hypot(tracked->match.reference_from_scan.x - truth.x, tracked->match.reference_from_scan.y - truth.y),
            0.015);
}

// Somebody stands so near that hardly any wall is in view.
TEST(ScanTracker, WhereAllThatIsSeenMovesTheMeasuredMotionIsTaken) {
  auto tracker = makeTracker();
  tracker.restart(scanBehindPerson(0, 1, 1), kOrigin, 0);
  for (int i = 1; i <= 20; ++i) {
    ASSERT_TRUE(tracker.track(scanBehindPerson(0.05 * i, 1, i + 1), kOrigin, {predicted({0.05, 0, 0})}, 0.1 * i,
                              byWheels(0.05)));
  }
  auto only_person = scanBehindPerson(0.05 * 21, 1, 22);
  std::vector<bool> walls;
  for (const int thing : only_person.things) walls.push_back(thing == ScanWithNormals::kNoThing);
  const auto tracked =
      tracker.track(without(walls, only_person), kOrigin, {predicted({0.05, 0, 0})}, 2.1, byWheels(0.05));
  ASSERT_TRUE(tracked);
  EXPECT_DOUBLE_EQ(tracked->match.reference_from_scan.x, 0.05);
  EXPECT_TRUE(tracked->match.degenerate);
  EXPECT_FALSE(tracked->is_determined);
}

}  // namespace
}  // namespace omnimapper::matching::scan_tracker_test
