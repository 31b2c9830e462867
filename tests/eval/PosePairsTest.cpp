#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/PosePairs.h>

#include <algorithm>
#include <set>

#include "Trajectories.h"

namespace omnimapper::eval::association_test {
namespace {

const auto kTenth = base::durationFromSeconds(0.1);

// Poses at these seconds, with their index as x.
Trajectory atSeconds(const std::vector<double>& seconds) {
  Trajectory trajectory;
  for (const double t : seconds) trajectory.push_back(planar(t, static_cast<double>(trajectory.size()), 0));
  return trajectory;
}

std::vector<std::pair<int, int>> pairsOf(const std::vector<double>& estimate, const std::vector<double>& reference,
                                         base::Duration tolerance = kTenth) {
  std::vector<std::pair<int, int>> indices;
  for (const auto& pair : associate(atSeconds(estimate), atSeconds(reference), tolerance)) {
    indices.emplace_back(std::lround(pair.estimate.translation.x()), std::lround(pair.reference.translation.x()));
  }
  return indices;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(Association, TakesTheNearestWithinTheTolerance) {
  EXPECT_EQ(pairsOf({1.0, 2.0, 3.0}, {0.95, 2.04, 2.06, 3.2}), (Pairs{{0, 0}, {1, 1}}));
  EXPECT_EQ(pairsOf({1.0}, {1.1}), (Pairs{{0, 0}}));  // the tolerance itself is within
  EXPECT_EQ(pairsOf({1.0}, {1.1000001}), Pairs{});
}

TEST(Association, UsesEachPoseOnceAndGivesItToTheNearest) {
  // Both are nearest to 2.0; 2.01 is nearer, so 1.95 gets the next free one, 1.9.
  EXPECT_EQ(pairsOf({1.95, 2.01}, {1.9, 2.0}), (Pairs{{0, 0}, {1, 1}}));
  // 1.97 is nearest to 2.0 and 1.95 comes away empty.
  EXPECT_EQ(pairsOf({1.95, 1.97}, {2.0}), (Pairs{{1, 0}}));
}

TEST(Association, OfEquallyNearPosesTheEarlierIsTaken) {
  EXPECT_EQ(pairsOf({2.0}, {1.95, 2.05}), (Pairs{{0, 0}}));
  EXPECT_EQ(pairsOf({1.95, 2.05}, {2.0}), (Pairs{{0, 0}}));
}

TEST(Association, ToleranceZeroIsExactToTheTick) {
  EXPECT_EQ(pairsOf({1.0, 2.0}, {1.0, 2.0000001}, base::Duration(0)), (Pairs{{0, 0}}));
}

TEST(Association, EmptyTrajectoriesHaveNoPairs) {
  EXPECT_EQ(pairsOf({}, {1.0}), Pairs{});
  EXPECT_EQ(pairsOf({1.0}, {}), Pairs{});
}

TEST(Association, ATrajectoryAndItselfPairOneToOneWhateverTheTolerance) {
  const Trajectory walk = randomWalk(3000, 1);
  const auto pairs = associate(walk, walk, base::durationFromSeconds(1e6));
  ASSERT_EQ(pairs.size(), walk.size());
  for (const auto& pair : pairs) EXPECT_EQ(pair.estimate.translation, pair.reference.translation);
}

TEST(Association, AgreesWithTheGreedyChoiceAmongAllPossiblePairs) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> seconds(0, 10);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> a(60), b(45);
    for (auto* times : {&a, &b}) {
      for (double& t : *times) t = seconds(random);
      std::sort(times->begin(), times->end());
    }
    const Trajectory estimate = atSeconds(a), reference = atSeconds(b);
    std::vector<std::tuple<base::Duration, int, int>> candidates;
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 45; ++j) {
        const base::Duration span = estimate[i].stamp - reference[j].stamp;
        const base::Duration distance = std::max(span, -span);
        if (distance <= kTenth) candidates.emplace_back(distance, i, j);
      }
    }
    std::sort(candidates.begin(), candidates.end());
    std::set<int> used_estimate, used_reference;
    std::set<std::pair<int, int>> expected;
    for (const auto& [distance, i, j] : candidates) {
      if (used_estimate.count(i) || used_reference.count(j)) continue;
      used_estimate.insert(i);
      used_reference.insert(j);
      expected.emplace(i, j);
    }
    const auto found = pairsOf(a, b);
    EXPECT_EQ(std::set(found.begin(), found.end()), expected) << "round " << round;
  }
}

TEST(Trajectory, InterpolatesOnTheLineAndTheShortestTurn) {
  // A quarter of the line from (0, 0) to (4, 8), and of the turn from +170 to -170 deg, which goes through 180.
  const double degree = geometry::kPi / 180;
  const Trajectory trajectory = {planar(0, 0, 0, 170 * degree), planar(2, 4, 8, -170 * degree)};
  const auto pose = interpolatedPose(trajectory, at(0.5), base::durationFromSeconds(2));
  ASSERT_TRUE(pose);
  const auto planar_pose = geometry::project(*pose);
  EXPECT_NEAR(planar_pose.x, 1, 1e-9);
  EXPECT_NEAR(planar_pose.y, 2, 1e-9);
  EXPECT_NEAR(planar_pose.yaw, 175 * degree, 1e-9);
}

TEST(Trajectory, InterpolatesNeitherOutsideNorOverLongGaps) {
  const Trajectory trajectory = {planar(0, 0, 0), planar(2, 4, 8)};
  const auto gap = base::durationFromSeconds(2);
  EXPECT_FALSE(interpolatedPose(trajectory, at(-0.1), gap));
  EXPECT_FALSE(interpolatedPose(trajectory, at(2.1), gap));
  EXPECT_TRUE(interpolatedPose(trajectory, at(0), gap));
  EXPECT_TRUE(interpolatedPose(trajectory, at(2), gap));
  EXPECT_FALSE(interpolatedPose(trajectory, at(1), base::durationFromSeconds(1.9)));
  EXPECT_TRUE(interpolatedPose(trajectory, at(2), base::durationFromSeconds(1.9)));  // no gap at a pose itself
  EXPECT_FALSE(interpolatedPose({}, at(2), gap));
}

TEST(Trajectory, InterpolatedPairsAreOfTheEstimatesStamps) {
  const Trajectory estimate = atSeconds({0.5, 1.0, 7.0});
  const Trajectory reference = {planar(0, 0, 0), planar(2, 4, 8)};
  const auto pairs = associateInterpolated(estimate, reference, base::durationFromSeconds(2));
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].stamp, at(1.0));
  EXPECT_TRUE(pairs[1].reference.translation.isApprox(Eigen::Vector3d(2, 4, 0)));
}

TEST(Trajectory, NearestPoseIsWithinTheToleranceAndTheEarlierOfTwo) {
  const Trajectory trajectory = atSeconds({1.0, 1.2});
  EXPECT_EQ(nearestPose(trajectory, at(1.1), kTenth), 0u);
  EXPECT_EQ(nearestPose(trajectory, at(1.11), kTenth), 1u);
  EXPECT_EQ(nearestPose(trajectory, at(0.9), kTenth), 0u);
  EXPECT_EQ(nearestPose(trajectory, at(0.89), kTenth), std::nullopt);
  EXPECT_EQ(nearestPose(trajectory, at(1.31), kTenth), std::nullopt);
  EXPECT_EQ(nearestPose({}, at(1.31), kTenth), std::nullopt);
}

TEST(Trajectory, TravelIsTheSumOfSteps) {
  // 3-4-5 triangle, then straight down: 5 m, 5 + 4 m.
  EXPECT_EQ(distanceTravelled({planar(0, 0, 0), planar(1, 3, 4), planar(2, 3, 0)}), (std::vector<double>{0, 5, 9}));
  EXPECT_TRUE(distanceTravelled({}).empty());
}

TEST(Trajectory, OfAPartTurnsWithTheBody) {
  // A sensor 1 m ahead of a base that looks along +y stands 1 m further in y.
  const Trajectory part = trajectoryOfPart({planar(0, 2, 3, geometry::kPi / 2)}, geometry::lift({1, 0, 0}));
  EXPECT_TRUE(part[0].world_from_body.translation.isApprox(Eigen::Vector3d(2, 4, 0)));
}

TEST(Trajectory, SortingRefusesAStampThatStandsTwice) {
  EXPECT_EQ(sortedByStamp({planar(2, 2, 0), planar(1, 1, 0)}, "log").front().stamp, at(1));
  EXPECT_THROW(sortedByStamp({planar(2, 2, 0), planar(1, 1, 0), planar(2, 0, 0)}, "log"), base::Error);
}

}  // namespace
}  // namespace omnimapper::eval::association_test
