#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/deskew.h>

#include <cmath>

#include "Scans.h"

namespace omnimapper::matching::deskew_test {
namespace {

using mrpt::math::TPose2D;
constexpr double kPi = 3.14159265358979323846;

TEST(Deskew, PointsAtTheBeginningStayAndThoseAtTheEndMoveByAllOfTheMotion) {
  const auto still = deskew({{1, 0}, {1, 0}}, {0, 1}, {2, 3, kPi / 2});
  EXPECT_LT((still[0] - Eigen::Vector2f(1, 0)).norm(), 1e-6);
  EXPECT_LT((still[1] - Eigen::Vector2f(2, 4)).norm(), 1e-6);
}

TEST(Deskew, HalfOfAStraightMotionMovesByHalf) {
  const auto still = deskew({{1, 2}}, {0.5F}, {0.4, -0.2, 0});
  EXPECT_LT((still[0] - Eigen::Vector2f(1.2F, 1.9F)).norm(), 1e-6);
}

TEST(Deskew, HalfOfATurnLiesOnTheArc) {
  // A quarter of a circle of radius 1 to the left, from the origin along x: half of it ends at 45 degrees.
  const auto still = deskew({{0, 0}}, {0.5F}, {1, 1, kPi / 2});
  EXPECT_LT((still[0] - Eigen::Vector2f(std::sin(kPi / 4), 1 - std::cos(kPi / 4))).norm(), 1e-6);
}

TEST(Deskew, WhatWasMeasuredBeforeTheInstantMovesBackAlongTheArc) {
  const auto still = deskew({{0, 0}}, {-0.5F}, {1, 1, kPi / 2});
  EXPECT_LT((still[0] - Eigen::Vector2f(-std::sin(kPi / 4), 1 - std::cos(kPi / 4))).norm(), 1e-6);
}

TEST(Deskew, RefusesPointsWithoutTheirFraction) {
  EXPECT_THROW(deskew({{1, 2}, {3, 4}}, {0.5F}, {0, 0, 0}), base::Error);
  EXPECT_TRUE(deskew({}, {}, {1, 1, 1}).empty());
}

TEST(Deskew, ASweepTakenOnTheMoveMatchesOnceItIsStraightened) {
  const auto plan = testing::FloorPlan::ring();
  const TPose2D motion(0.15, 0.01, 0.25);  // in one sweep
  const TPose2D begin(0.2, 0.1, 0.05);
  std::vector<Eigen::Vector2f> skewed;
  std::vector<float> fractions;
  for (int i = -90; i <= 90; ++i) {
    const float fraction = static_cast<float>(i + 90) / 180;
    // Pose of the sensor at this beam: the deskewed origin of its frame, and its heading.
    const auto at = deskew({{0, 0}}, {fraction}, motion)[0];
    const TPose2D sensor = begin + TPose2D(at.x(), at.y(), fraction * motion.phi);
    const double angle = i * kPi / 180;
    const double range =
        plan.distanceToWall({sensor.x, sensor.y}, {std::cos(sensor.phi + angle), std::sin(sensor.phi + angle)});
    if (range > 12) continue;
    skewed.emplace_back(range * std::cos(angle), range * std::sin(angle));
    fractions.push_back(fraction);
  }
  const PointToLineMatcher matcher(ScanMatcherOptions{});
  const auto reference = matcher.prepare(scanFrom(plan, {0, 0, 0}));
  const auto error = [&](const std::vector<Eigen::Vector2f>& points) {
    const auto found = matcher.match(*reference, fitLines(points), begin).reference_from_scan - begin;
    return std::hypot(found.x, found.y) + std::abs(found.phi);
  };
  EXPECT_GT(error(skewed), 0.05);
  EXPECT_LT(error(deskew(skewed, fractions, motion)), 0.01);
}

}  // namespace
}  // namespace omnimapper::matching::deskew_test
