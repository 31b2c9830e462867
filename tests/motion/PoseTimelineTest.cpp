#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/motion/PoseTimeline.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::motion::pose_timeline_test {
namespace {

using mrpt::poses::CPose3D;
using Covariance = Eigen::Matrix<double, 6, 6>;
using testing::Dice;

constexpr double kQuarterTurn = geometry::kPi / 2;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

Covariance diagonal(double position, double angle) {
  Covariance covariance = Covariance::Zero();
  covariance.diagonal() << position, position, position, angle, angle, angle;
  return covariance;
}

void expectNear(const RelativeMotion& a, const RelativeMotion& b, double tolerance) {
  const auto difference = minus(geometry::fromMrpt(a.begin_from_end), geometry::fromMrpt(b.begin_from_end));
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((a.covariance - b.covariance).cwiseAbs().maxCoeff(), tolerance);
}

// Spans of uneven length one after the other, with any motion and any covariance.
struct RandomTimeline {
  explicit RandomTimeline(std::uint64_t seed) : dice(seed) {
    for (int i = 0; i < 20; ++i) {
      const base::Stamp begin = length, end = begin + base::durationFromSeconds(dice.uniform(0.01, 2));
      const auto any = [&] { return dice.uniform(-1, 1); };
      const CPose3D motion(any(), any(), any(), 3 * any(), any(), 3 * any());
      const Covariance root = Covariance::NullaryExpr([&](Eigen::Index, Eigen::Index) { return 0.1 * any(); });
      EXPECT_TRUE(timeline.insert(begin, end, {motion, root * root.transpose()}));
      length = end;
    }
  }
  base::Stamp any() { return at(dice.uniform(0, base::secondsBetween(at(0), length))); }

  Dice dice;
  base::Stamp length = at(0);
  PoseTimeline timeline;
};

TEST(PoseTimeline, TwoSpansComposeAsWorkedByHand) {
  PoseTimeline timeline;
  ASSERT_TRUE(timeline.insert(at(0), at(1), {CPose3D(1, 0, 0, kQuarterTurn, 0, 0), diagonal(0, 0.01)}));
  ASSERT_TRUE(timeline.insert(at(1), at(2), {CPose3D(2, 0, 0, 0, 0, 0), diagonal(0.5, 0)}));
  const auto motion = timeline.between(at(0), at(2));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.x(), 1, 1e-12);
  EXPECT_NEAR(motion->begin_from_end.y(), 2, 1e-12);
  EXPECT_NEAR(motion->begin_from_end.yaw(), kQuarterTurn, 1e-12);
  // A heading error of variance 0.01 swings the end of a lever of 2 m: 4 * 0.01 across, 2 * 0.01 mixed with yaw.
  EXPECT_NEAR(motion->covariance(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(motion->covariance(1, 1), 0.54, 1e-12);
  EXPECT_NEAR(motion->covariance(1, 5), 0.02, 1e-12);
  EXPECT_NEAR(motion->covariance(5, 5), 0.01, 1e-12);
}

TEST(PoseTimeline, APartOfASpanIsItsShareOfTheMotion) {
  PoseTimeline timeline;
  ASSERT_TRUE(timeline.insert(at(10), at(14), {CPose3D(2, 0, 0, 0, 0, 0), diagonal(0.4, 0)}));
  const auto quarter = timeline.between(at(11), at(12));
  ASSERT_TRUE(quarter);
  EXPECT_NEAR(quarter->begin_from_end.x(), 0.5, 1e-12);
  EXPECT_NEAR(quarter->covariance(0, 0), 0.1, 1e-12);
  const auto none = timeline.between(at(12), at(12));
  ASSERT_TRUE(none);
  expectNear(*none, identityMotion(), 1e-15);
}

TEST(PoseTimeline, MotionAndCovarianceAddUpWhereverTheSpanIsSplit) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RandomTimeline random(seed);
    for (int i = 0; i < 20; ++i) {
      base::Stamp stamps[] = {random.any(), random.any(), random.any()};
      std::sort(std::begin(stamps), std::end(stamps));
      const auto& [a, b, c] = stamps;
      const auto whole = random.timeline.between(a, c), first = random.timeline.between(a, b),
                 second = random.timeline.between(b, c);
      ASSERT_TRUE(whole && first && second);
      const double scale = 1 + whole->covariance.cwiseAbs().maxCoeff() + first->covariance.cwiseAbs().maxCoeff();
      expectNear(*whole, compose(*first, *second), 1e-12 * scale);
    }
  }
}

TEST(PoseTimeline, EveryPartHasACovarianceWithoutNegativeDirections) {
  RandomTimeline random(7);
  for (int i = 0; i < 200; ++i) {
    const auto a = random.any(), b = random.any();
    const auto part = random.timeline.between(std::min(a, b), std::max(a, b));
    ASSERT_TRUE(part);
    EXPECT_LT((part->covariance - part->covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::SelfAdjointEigenSolver<Covariance> eigen(part->covariance);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9);
  }
}

TEST(PoseTimeline, ThereIsNoMotionAcrossAGapOrBeyondTheEnds) {
  PoseTimeline timeline;
  EXPECT_FALSE(timeline.end());
  EXPECT_FALSE(timeline.between(at(0), at(0)));
  ASSERT_TRUE(timeline.insert(at(0), at(1), identityMotion()));
  ASSERT_TRUE(timeline.insert(at(2), at(3), identityMotion()));
  EXPECT_EQ(*timeline.end(), at(3));
  EXPECT_TRUE(timeline.between(at(0), at(1)));
  EXPECT_TRUE(timeline.between(at(2), at(3)));
  EXPECT_FALSE(timeline.between(at(1), at(2)));
  EXPECT_FALSE(timeline.between(at(0.5), at(2.5)));
  EXPECT_FALSE(timeline.between(at(-0.1), at(0.5)));
  EXPECT_FALSE(timeline.between(at(2.5), at(3.1)));
  EXPECT_FALSE(timeline.between(at(0.6), at(0.5)));
}

TEST(PoseTimeline, RefusesWhatDoesNotFollowOrIsNotFiniteAndStaysAsItWas) {
  PoseTimeline timeline;
  ASSERT_TRUE(timeline.insert(at(0), at(1), {CPose3D(1, 0, 0, 0, 0, 0), diagonal(1, 1)}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(timeline.insert(at(1), at(1), identityMotion()));
  EXPECT_FALSE(timeline.insert(at(2), at(1.5), identityMotion()));
  EXPECT_FALSE(timeline.insert(at(0.9), at(2), identityMotion()));
  EXPECT_FALSE(timeline.insert(at(1), at(2), {CPose3D(nan, 0, 0, 0, 0, 0), diagonal(1, 1)}));
  EXPECT_FALSE(timeline.insert(at(1), at(2), {CPose3D(0, inf, 0, 0, 0, 0), diagonal(1, 1)}));
  EXPECT_FALSE(timeline.insert(at(1), at(2), {CPose3D(0, 0, 0, nan, 0, 0), diagonal(1, 1)}));
  EXPECT_FALSE(timeline.insert(at(1), at(2), {CPose3D(), diagonal(nan, 1)}));
  EXPECT_EQ(*timeline.end(), at(1));
  EXPECT_TRUE(timeline.insert(at(1), at(2), identityMotion()));
  EXPECT_NEAR(timeline.between(at(0), at(2))->begin_from_end.x(), 1, 1e-12);
}

TEST(PoseTimeline, ForgettingLeavesLaterSpansAsTheyWere) {
  RandomTimeline random(3);
  const base::Stamp middle = random.any();
  const auto before = random.timeline.between(middle, random.length);
  ASSERT_TRUE(before);
  random.timeline.forgetBefore(middle);
  const auto after = random.timeline.between(middle, random.length);
  ASSERT_TRUE(after);
  expectNear(*before, *after, 1e-15);
  EXPECT_FALSE(random.timeline.between(at(0), random.length));
  EXPECT_EQ(*random.timeline.end(), random.length);
}

}  // namespace
}  // namespace omnimapper::motion::pose_timeline_test
