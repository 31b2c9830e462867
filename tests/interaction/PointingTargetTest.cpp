#include <gtest/gtest.h>
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/interaction/PointingTarget.h>

#include <array>
#include <cmath>
#include <numeric>

#include "Gestures.h"
#include "Sight.h"

namespace omnimapper::interaction::pointing_target_test {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

PointingModel exactPeople(double sigma) {
  PointingModel model;
  const AngleError angle{0, sigma};
  model.rows = {{"", {}, {angle, angle}, {angle, angle}}};
  return model;
}

// The elbow is behind the hand, so the ray goes along x; there is no head.
PointingGesture alongX() {
  PointingGesture gesture;
  gesture.hand = {0, 0, 1};
  gesture.elbow = Vector3d(-0.3, 0, 1);
  gesture.sensor = {2, 0, 1};
  return gesture;
}

PointedCandidate pointAt(const Vector3d& point) {
  return {{point}, {}, true};
}

PointedCandidate wallAt(double x, double half_y, double half_z) {
  return {{},
          {{{x, -half_y, 1 - half_z}, {x, half_y, 1 - half_z}, {x, half_y, 1 + half_z}, {x, -half_y, 1 + half_z}}},
          true};
}

// One candidate 0.1 rad to the side, with sigma 0.1 rad: the square of the Mahalanobis distance is 1, the density of
// Student's t with 20 degrees of freedom in two dimensions (1 + 1/20)^-11 / (2 pi 0.01), and that of nothing 1 / (4
// pi).
TEST(PointingTarget, theProbabilityOfOneCandidateIsThatWorkedByHand) {
  const double tangent = std::tan(0.1), solid = std::pow(1 + tangent * tangent, 1.5) / (1 + tangent * tangent);
  const double density = std::pow(1.05, -11) / 0.01 * solid;
  const auto answer = determineTarget(alongX(), {pointAt({1, tangent, 1})}, exactPeople(0.1), {});
  ASSERT_EQ(answer.probabilities.size(), 1u);
  EXPECT_NEAR(answer.probabilities[0], 0.98 * density / (0.98 * density + 0.02 / 2), 1e-12);
  EXPECT_NEAR(answer.nothing, 1 - answer.probabilities[0], 1e-12);
  EXPECT_EQ(answer.verdict, TargetVerdict::this_one);
}

// Both rays see the same point, at errors of 0.1 rad and none: with equal variances their mean counts, with half the
// variance; with correlation 1/2, three quarters of it.
TEST(PointingTarget, bothRaysCountByTheirCovariance) {
  PointingGesture gesture = alongX();
  const Vector3d target(1, std::tan(0.1), 1);
  gesture.head = gesture.hand - 0.6 * (target - gesture.hand).normalized();
  PointingModel model = exactPeople(0.1);
  const auto oddsWith = [&](double correlation) {
    model.theta_correlation = model.psi_correlation = correlation;
    const auto answer = determineTarget(gesture, {pointAt(target)}, model, {});
    return answer.probabilities[0] / answer.nothing;
  };
  const auto expected = [&](double variance) {
    const double u = std::tan(0.05), density = std::pow(1 + 0.05 * 0.05 / variance / 20, -11) / variance;
    return 98 * density * std::pow(1 + u * u, 0.5);
  };
  EXPECT_NEAR(oddsWith(0) / expected(0.005), 1, 1e-6);
  EXPECT_NEAR(oddsWith(0.5) / expected(0.0075), 1, 1e-6);
}

TEST(PointingTarget, twoThatAreAlikeAreAskedBack) {
  const auto answer = determineTarget(alongX(), {pointAt({1, 0.1, 1}), pointAt({1, -0.1, 1}), pointAt({0, 3, 1})},
                                      exactPeople(0.1), {});
  EXPECT_EQ(answer.verdict, TargetVerdict::one_of_these);
  EXPECT_EQ(answer.candidates, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(answer.probabilities[0], answer.probabilities[1], 1e-12);
}

TEST(PointingTarget, farFromAllItMeansNothing) {
  const auto answer = determineTarget(alongX(), {pointAt({0, 2, 1}), pointAt({-2, 0, 1})}, exactPeople(0.1), {});
  EXPECT_EQ(answer.verdict, TargetVerdict::nothing);
  EXPECT_TRUE(answer.candidates.empty());
  EXPECT_GT(answer.nothing, 0.99);
  EXPECT_EQ(determineTarget(alongX(), {}, exactPeople(0.1), {}).verdict, TargetVerdict::nothing);
  PointingGesture nowhere = alongX();
  nowhere.elbow = nowhere.hand;
  EXPECT_EQ(determineTarget(nowhere, {pointAt({1, 0, 1})}, exactPeople(0.1), {}).verdict, TargetVerdict::nothing);
}

TEST(PointingTarget, whatIsOutOfRangeOrMayNotBeMeantIsNoTarget) {
  TargetOptions options;
  options.max_range = 2;
  EXPECT_EQ(determineTarget(alongX(), {pointAt({3, 0, 1})}, exactPeople(0.1), options).verdict, TargetVerdict::nothing);
  auto other = pointAt({1, 0, 1});
  other.may_be_meant = false;
  EXPECT_EQ(determineTarget(alongX(), {other}, exactPeople(0.1), options).verdict, TargetVerdict::nothing);
}

// A wall that fills the view: the integral over its directions is 1, so its density is 1 / its solid angle.
TEST(PointingTarget, aSurfaceIsAimedAtAnywhere) {
  const PointedCandidate wall = wallAt(1, 3, 3);
  const double solid = Sight({0, 0, 1}, {wall}).solidAngle(0);
  const auto answer = determineTarget(alongX(), {wall}, exactPeople(0.05), {});
  const double expected = 49 / solid * (4 * M_PI);
  EXPECT_NEAR(answer.probabilities[0] / answer.nothing / expected, 1, 0.02);
}

TEST(PointingTarget, theNearestSurfaceHidesThoseBehind) {
  const auto answer = determineTarget(alongX(), {wallAt(2, 1, 1), wallAt(1, 1, 1)}, exactPeople(0.05), {});
  EXPECT_EQ(answer.verdict, TargetVerdict::this_one);
  EXPECT_EQ(answer.candidates, std::vector<std::size_t>{1});
  EXPECT_EQ(answer.probabilities[0], 0);
  EXPECT_EQ(determineTargetAsThesis(alongX(), {wallAt(2, 1, 1), wallAt(1, 1, 1)}, exactPeople(0.05),
                                    PointingMethod::elbow_hand)
                .candidates,
            std::vector<std::size_t>{1});
}

TEST(PointingTarget, whatIsSeldomMeantCountsLess) {
  auto seldom = pointAt({1, 0.1, 1});
  seldom.weight = 0.1;
  const auto answer = determineTarget(alongX(), {seldom, pointAt({1, -0.1, 1})}, exactPeople(0.1), {});
  EXPECT_NEAR(answer.probabilities[1] / answer.probabilities[0], 10, 1e-9);
  const auto both = determineTarget(alongX(), {seldom, seldom}, exactPeople(0.1), {});
  EXPECT_NEAR(both.probabilities[0], both.probabilities[1], 1e-12);
}

// The wall was seen from 1.5 m on, and goes on down to the floor; the ray is at 1 m.
TEST(PointingTarget, aWallThatGoesOnUnseenIsMeantThereButHidesNothing) {
  auto wall = wallAt(2, 1, 0.5);
  for (auto& corner : wall.outline.vertices) corner.z() += 1;
  EXPECT_EQ(determineTarget(alongX(), {wall}, exactPeople(0.05), {}).verdict, TargetVerdict::nothing);
  wall.reach = wallAt(2, 1, 1).outline;
  const auto answer = determineTarget(alongX(), {wall}, exactPeople(0.05), {});
  EXPECT_EQ(answer.verdict, TargetVerdict::this_one);
  const auto before = determineTarget(alongX(), {wall, wallAt(3, 1, 1)}, exactPeople(0.05), {});
  ASSERT_EQ(before.verdict, TargetVerdict::this_one);
  EXPECT_EQ(before.candidates, std::vector<std::size_t>{1}) << "what was seen behind it";
}

TEST(PointingTarget, aWallHidesTheCupBehindItAndNotTheOneOnIt) {
  const auto cup = [](double x) { return PointedCandidate{canAt({x, 0, 1}), {}, true}; };
  EXPECT_EQ(determineTarget(alongX(), {wallAt(1, 1, 1), cup(1.5)}, exactPeople(0.05), {}).probabilities[1], 0);
  const auto before = determineTarget(alongX(), {wallAt(1, 1, 1), cup(0.95)}, exactPeople(0.05), {});
  EXPECT_EQ(before.candidates, std::vector<std::size_t>{1});
}

TEST(PointingTarget, anObjectHidesTheSurfaceBehindIt) {
  // A large box close to the hand covers all directions that matter.
  PointedCandidate box;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) box.points.push_back({0.5, 0.1 * i, 1 + 0.1 * j});
  const auto answer = determineTarget(alongX(), {wallAt(2, 1, 1), box}, exactPeople(0.05), {});
  EXPECT_LT(answer.probabilities[0], 1e-6);
  EXPECT_EQ(answer.candidates, std::vector<std::size_t>{1});
}

TEST(PointingTarget, leftArmsAreMirrored) {
  const PointingModel model{{thesisRow(SkeletonSoftware::openni, 5)}};
  const PointingError elbow{-0.2, 0.1}, head{-0.15, -0.1};
  const Vector3d right(1.2, -0.4, 0.9), left(1.2, 0.4, 0.9);
  const auto of_right = determineTarget(gestureWith(right, elbow, head), {{canAt(right), {}, true}}, model, {});
  const auto of_left = determineTarget(gestureWith(left, elbow, head, false), {{canAt(left), {}, true}}, model, {});
  EXPECT_NEAR(of_right.nothing, of_left.nothing, 1e-9);
  EXPECT_NEAR(directionOf(gestureWith(right, elbow, head), right).azimuth,
              directionOf(gestureWith(left, elbow, head, false), left).azimuth, 1e-12);
}

TEST(PointingTarget, errorsAreThoseThatTheGestureHas) {
  const Vector3d target(1, -0.5, 0.7);
  for (const bool right : {true, false}) {
    const auto errors = errorsOf(gestureWith(target, {0.1, 0.2}, {-0.3, -0.1}, right), target);
    EXPECT_NEAR(errors.elbow_hand->theta, 0.1, 1e-9);
    EXPECT_NEAR(errors.elbow_hand->psi, 0.2, 1e-9);
    EXPECT_NEAR(errors.head_hand->theta, -0.3, 1e-9);
  }
}

// The face of a cube, seen from its middle, is a sixth of the sphere.
TEST(Sight, solidAnglesAreThoseOfTheSphere) {
  EXPECT_NEAR(Sight({0, 0, 1}, {wallAt(1, 1, 1)}).solidAngle(0), 4 * M_PI / 6, 1e-12);
  // An L whose notch is missing from the face.
  PointedCandidate part{{}, {{{1, -1, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}, {1, 0, 2}, {1, -1, 2}}}, true};
  EXPECT_NEAR(Sight({0, 0, 1}, {part}).solidAngle(0), 4 * M_PI / 6 * 0.75, 1e-12);
}

// Distances in degrees: an error of 4 deg with sigma 2 deg is 2 sigma, and 4 / sqrt(2) by the rule of the thesis.
TEST(ThesisRule, itsMatrixHoldsSigmaAndOursItsSquare) {
  const Vector3d target(1, std::tan(4 * kDegree), 1);
  const PointingModel model = exactPeople(2 * kDegree);
  EXPECT_NEAR(mahalanobis(alongX(), target, model, PointingMethod::elbow_hand, true), 2, 1e-9);
  EXPECT_NEAR(mahalanobis(alongX(), target, model, PointingMethod::elbow_hand, false), 4 / std::sqrt(2), 1e-9);
}

TEST(ThesisRule, asksWhereTheLeastDistanceIsHardlyLess) {
  const PointingModel model = exactPeople(4 * kDegree);
  const auto verdict = [&](double y, double other_y) {
    return determineTargetAsThesis(alongX(), {pointAt({1, y, 1}), pointAt({1, other_y, 1})}, model,
                                   PointingMethod::elbow_hand)
        .verdict;
  };
  EXPECT_EQ(verdict(0.02, 0.022), TargetVerdict::one_of_these);
  EXPECT_EQ(verdict(0.02, 0.05), TargetVerdict::this_one);
  EXPECT_EQ(verdict(0.02, 0.5), TargetVerdict::this_one);
  EXPECT_EQ(verdict(0.4, 0.5), TargetVerdict::nothing);
}

}  // namespace
}  // namespace omnimapper::interaction::pointing_target_test
