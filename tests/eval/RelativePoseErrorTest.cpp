#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/RelativePoseError.h>

#include "Trajectories.h"

namespace omnimapper::eval::relative_pose_error_test {
namespace {

PairingOptions aligning(Alignment alignment) {
  PairingOptions options;
  options.alignment = alignment;
  return options;
}

RelativePoseError rpe(const Trajectory& estimate, const Trajectory& reference, double delta, DeltaUnit unit) {
  return relativePoseError(estimate, reference, {}, {delta, unit});
}

// Straight along x in steps of `step` metres, a pose each at these seconds.
Trajectory straight(const std::vector<double>& seconds, double step) {
  Trajectory trajectory;
  for (const double t : seconds) trajectory.push_back(planar(t, step * static_cast<double>(trajectory.size()), 0));
  return trajectory;
}

TEST(RelativePoseError, OfOneStepWorkedByHand) {
  // The reference goes 1 m ahead; the estimate goes to (1, 1) and turns left by 90 deg. Seen from where the reference
  // ended, the estimate ended 1 m to the left and turned by 90 deg.
  const Trajectory reference = {planar(0, 0, 0), planar(1, 1, 0)};
  const Trajectory estimate = {planar(0, 0, 0), planar(1, 1, 1, geometry::kPi / 2)};
  const auto error = rpe(estimate, reference, 1, DeltaUnit::frames);
  ASSERT_EQ(error.stamps.size(), 1u);
  EXPECT_EQ(error.stamps[0], at(0));
  EXPECT_NEAR(error.translation.rmse, 1, 1e-12);
  EXPECT_NEAR(error.rotation.rmse, geometry::kPi / 2, 1e-12);
}

TEST(RelativePoseError, GrowsWithTheSpanForAWrongScale) {
  // Steps of 1.1 m instead of 1: off by 0.1 m a frame. 5 poses have 4 spans of one frame and 2 of three.
  const Trajectory reference = straight({0, 1, 2, 3, 4}, 1), estimate = straight({0, 1, 2, 3, 4}, 1.1);
  const auto one = rpe(estimate, reference, 1, DeltaUnit::frames);
  EXPECT_EQ(one.translation.count, 4u);
  EXPECT_NEAR(one.translation.mean, 0.1, 1e-12);
  EXPECT_NEAR(one.translation.std, 0, 1e-7);
  const auto three = rpe(estimate, reference, 3, DeltaUnit::frames);
  EXPECT_EQ(three.translation.count, 2u);
  EXPECT_NEAR(three.translation.max, 0.3, 1e-12);
}

TEST(RelativePoseError, OnlyScaleOfAnAlignmentChangesIt) {
  const Trajectory reference = straight({0, 1, 2, 3, 4}, 1), estimate = straight({0, 1, 2, 3, 4}, 0.5);
  for (const auto alignment : {Alignment::none, Alignment::first, Alignment::yaw, Alignment::se3}) {
    EXPECT_NEAR(relativePoseError(estimate, reference, aligning(alignment)).translation.mean, 0.5, 1e-9);
  }
  EXPECT_NEAR(relativePoseError(estimate, reference, aligning(Alignment::sim3)).translation.max, 0, 1e-9);
}

TEST(RelativePoseError, DoesNotDependOnTheEstimatesWorld) {
  for (unsigned seed = 1; seed < 9; ++seed) {
    const Trajectory reference = randomWalk(60, seed), estimate = withNoise(reference, 0.2, seed + 50);
    for (const Delta delta :
         {Delta{2, DeltaUnit::frames}, Delta{5, DeltaUnit::seconds}, Delta{10, DeltaUnit::metres}}) {
      const auto here = relativePoseError(estimate, reference, {}, delta);
      const auto there = relativePoseError(inOtherWorld(someMotion(), estimate), reference, {}, delta);
      EXPECT_NEAR(here.translation.rmse, there.translation.rmse, 1e-9);
      EXPECT_NEAR(here.rotation.rmse, there.rotation.rmse, 1e-8);
      EXPECT_GT(here.translation.rmse, 0.05);
    }
  }
}

TEST(RelativePoseError, IsZeroForTheTruthInAnyWorld) {
  const Trajectory reference = randomWalk(60, 2);
  const auto error = rpe(inOtherWorld(someMotion(), reference), reference, 3, DeltaUnit::frames);
  EXPECT_LT(error.translation.max, 1e-9);
  EXPECT_LT(error.rotation.max, 1e-7);
}

TEST(RelativePoseError, SecondsTakeThePoseNearestToTheDeltaAndLeaveOutSpansATenthOff) {
  // Two seconds after 0: 2.1 (off by 0.1, within a tenth of 2 s). After 1: 2.9 (0.1 off). After 2.1: 4.1 (exact).
  // After 2.9: nothing nearer than 4.1 (0.8 off), left out; after 4.1 nothing at all.
  const std::vector<double> seconds = {0, 1, 2.1, 2.9, 4.1};
  const auto error = rpe(straight(seconds, 1.1), straight(seconds, 1), 2, DeltaUnit::seconds);
  EXPECT_EQ(error.stamps, (std::vector<base::Stamp>{at(0), at(1), at(2.1)}));
  for (const double translation : error.translation_errors) EXPECT_NEAR(translation, 0.2, 1e-12);  // two steps each
}

TEST(RelativePoseError, MetresAreTravelledByTheReference) {
  // The reference goes 0.5 m a step, so 1 m is two steps; the estimate does 0.2 m too much in each.
  const std::vector<double> seconds = {0, 1, 2, 3, 4};
  const auto error = rpe(straight(seconds, 0.7), straight(seconds, 0.5), 1, DeltaUnit::metres);
  EXPECT_EQ(error.translation.count, 3u);
  EXPECT_NEAR(error.translation.mean, 0.4, 1e-12);
}

TEST(RelativePoseError, AStandingReferenceHasNoSpanOfMetres) {
  const std::vector<double> seconds = {0, 1, 2, 3};
  EXPECT_THROW(rpe(straight(seconds, 1), straight(seconds, 0), 1, DeltaUnit::metres), base::Error);
}

TEST(RelativePoseError, RefusesADeltaThatIsNotPositiveNoWholeFrameOrTooLong) {
  const Trajectory walk = randomWalk(10, 1);
  for (const Delta delta : {Delta{0, DeltaUnit::frames}, Delta{-1, DeltaUnit::seconds}, Delta{1.5, DeltaUnit::frames},
                            Delta{std::nan(""), DeltaUnit::metres}}) {
    try {
      relativePoseError(walk, walk, {}, delta);
      ADD_FAILURE() << delta.value;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    }
  }
  EXPECT_THROW(rpe(walk, walk, 10, DeltaUnit::frames), base::Error);
  EXPECT_NO_THROW(rpe(walk, walk, 9, DeltaUnit::frames));
}

TEST(RelativePoseError, UnitsAreChosenByName) {
  EXPECT_EQ(deltaUnitNamed("frames"), DeltaUnit::frames);
  EXPECT_EQ(deltaUnitNamed("s"), DeltaUnit::seconds);
  EXPECT_EQ(deltaUnitNamed("m"), DeltaUnit::metres);
  EXPECT_THROW(deltaUnitNamed("km"), base::Error);
}

}  // namespace
}  // namespace omnimapper::eval::relative_pose_error_test
