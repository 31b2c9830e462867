#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>

#include "Trajectories.h"

namespace omnimapper::eval::absolute_trajectory_error_test {
namespace {

PairingOptions aligning(Alignment alignment) {
  PairingOptions options;
  options.alignment = alignment;
  return options;
}

AbsoluteTrajectoryError ate(const Trajectory& estimate, const Trajectory& reference, Alignment alignment) {
  return absoluteTrajectoryError(estimate, reference, aligning(alignment));
}

constexpr double kDegree = geometry::kPi / 180;

TEST(Statistics, OfFourValuesWorkedByHand) {
  // 1 2 2 7: mean 3, squares 1 + 4 + 4 + 49 = 58, rmse sqrt(14.5); deviations 4 + 1 + 1 + 16 = 22, std sqrt(5.5).
  const Statistics s = statisticsOf({2, 7, 1, 2});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(14.5));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(5.5));
  EXPECT_DOUBLE_EQ(s.median, 2);
  EXPECT_DOUBLE_EQ(s.max, 7);
  EXPECT_DOUBLE_EQ(statisticsOf({5, 1, 2}).median, 2);
  EXPECT_EQ(statisticsOf({}).count, 0u);
  EXPECT_EQ(statisticsOf({}).rmse, 0);
}

TEST(Statistics, ShareWithinCountsTheThresholdItself) {
  EXPECT_DOUBLE_EQ(shareWithin({0.1, 0.2, 0.3, 0.4}, 0.3), 0.75);
  EXPECT_EQ(shareWithin({}, 1), 0);
}

TEST(AbsoluteTrajectoryError, WithoutAlignmentIsTheDistanceAndAngleOfEachPair) {
  // Distances 0, 0.3, 0.4: mean 0.7/3, rmse sqrt(0.25/3), median 0.3. Angles 30, 0, 0 deg: mean 10, rmse sqrt(300).
  const Trajectory estimate = {planar(0, 0, 0, 10 * kDegree), planar(1, 1, 0), planar(2, 2, 0), planar(9, 7, 7)};
  const Trajectory reference = {planar(0, 0, 0, -20 * kDegree), planar(1, 1, 0.3), planar(2, 2, -0.4)};
  const auto error = ate(estimate, reference, Alignment::none);
  EXPECT_NEAR(error.translation.mean, 0.7 / 3, 1e-12);
  EXPECT_NEAR(error.translation.rmse, std::sqrt(0.25 / 3), 1e-12);
  EXPECT_NEAR(error.translation.median, 0.3, 1e-12);
  EXPECT_NEAR(error.translation.max, 0.4, 1e-12);
  EXPECT_NEAR(error.translation.std, std::sqrt(0.25 / 3 - 0.49 / 9), 1e-12);
  EXPECT_NEAR(error.rotation.mean, 10 * kDegree, 1e-12);
  EXPECT_NEAR(error.rotation.rmse, std::sqrt(300) * kDegree, 1e-12);
  EXPECT_NEAR(error.rotation.max, 30 * kDegree, 1e-12);
  EXPECT_EQ(error.paired.pairs.size(), 3u);
  EXPECT_EQ(error.paired.unpaired, 1u);
}

TEST(AbsoluteTrajectoryError, HintsAtFramesThatAreNotTheSame) {
  const Trajectory straight = {planar(0, 0, 0), planar(1, 1, 0)};
  const Trajectory apart = {planar(0, 5, 0), planar(1, 6, 0)}, turned = {planar(0, 0, 0, 1), planar(1, 1, 0, 1)};
  const auto hints = [&](const Trajectory& reference, Alignment alignment) {
    return hintsOn(ate(straight, reference, alignment), alignment);
  };
  EXPECT_EQ(hints(straight, Alignment::none), "");
  EXPECT_NE(hints(apart, Alignment::none).find("--align yaw"), std::string::npos);
  EXPECT_EQ(hints(apart, Alignment::yaw), "");
  EXPECT_NE(hints(turned, Alignment::none).find("--align se3"), std::string::npos);
  const auto of_axes = hints(turned, Alignment::se3);
  EXPECT_EQ(of_axes.find("--align se3"), std::string::npos) << of_axes;
  EXPECT_NE(of_axes.find("OUT.truth.tum"), std::string::npos) << of_axes;
}

TEST(AbsoluteTrajectoryError, ATurnThatAllPosesShareIsSaidToBeOfTheAlignment) {
  // All poses look 5 degrees aside of their direction of travel.
  const Trajectory truth = {planar(0, 0, 0), planar(1, 1, 0), planar(2, 1, 1)};
  const Trajectory aside = {planar(0, 0, 0, 5 * kDegree), planar(1, 1, 0, 5 * kDegree), planar(2, 1, 1, 5 * kDegree)};
  const Trajectory mixed = {planar(0, 0, 0, 5 * kDegree), planar(1, 1, 0, -5 * kDegree), planar(2, 1, 1)};
  const auto hints = [&](const Trajectory& estimate, Alignment alignment) {
    return hintsOn(ate(estimate, truth, alignment), alignment);
  };
  EXPECT_NE(hints(aside, Alignment::se3).find("--align first"), std::string::npos);
  EXPECT_EQ(hints(aside, Alignment::none), "") << "nothing was aligned";
  EXPECT_EQ(hints(mixed, Alignment::se3), "");
}

TEST(AbsoluteTrajectoryError, AlignedByTheFirstPoseStartsWithoutError) {
  // The estimate starts at (5, 5) looking along +y; its step of 1 m ahead is then 1 m along x, the reference's is 1.5.
  const Trajectory estimate = {planar(0, 5, 5, 90 * kDegree), planar(1, 5, 6, 90 * kDegree)};
  const Trajectory reference = {planar(0, 0, 0), planar(1, 1.5, 0)};
  const auto error = ate(estimate, reference, Alignment::first);
  EXPECT_NEAR(error.translation_errors[0], 0, 1e-12);
  EXPECT_NEAR(error.translation_errors[1], 0.5, 1e-12);
  EXPECT_NEAR(error.rotation.max, 0, 1e-7);
}

TEST(AbsoluteTrajectoryError, YawAlignmentFindsTheRotationOfUmeyamasExample) {
  // Umeyama 1991, section IV: (0,0) (1,0) (0,2) to (0,0) (-1,0) (0,2) gives R = [3 2; -2 3] / sqrt(13). Without its
  // scale, t = mean' - R mean = (-1/3, 2/3) - R (1/3, 2/3).
  const Trajectory estimate = {planar(0, 0, 0), planar(1, 1, 0), planar(2, 0, 2)};
  const Trajectory reference = {planar(0, 0, 0), planar(1, -1, 0), planar(2, 0, 2)};
  const auto fit = ate(estimate, reference, Alignment::yaw).paired.reference_from_estimate;
  const auto motion = geometry::project(fit.motion);
  EXPECT_NEAR(motion.yaw, std::atan2(-2, 3), 1e-12);
  EXPECT_NEAR(motion.x, -1.0 / 3 - (3.0 / 3 + 2 * 2.0 / 3) / std::sqrt(13), 1e-12);
  EXPECT_NEAR(motion.y, 2.0 / 3 - (-2.0 / 3 + 3 * 2.0 / 3) / std::sqrt(13), 1e-12);
  EXPECT_EQ(fit.scale, 1);
}

TEST(AbsoluteTrajectoryError, Sim3AlignmentRecoversScaleRotationAndTranslation) {
  const Trajectory reference = randomWalk(50, 5);
  Trajectory estimate = inOtherWorld(someMotion(), reference);
  for (auto& [stamp, pose] : estimate) pose.translation *= 0.4;
  const auto error = ate(estimate, reference, Alignment::sim3);
  EXPECT_NEAR(error.paired.reference_from_estimate.scale, 2.5, 1e-9);
  EXPECT_LT(error.translation.max, 1e-9);
  EXPECT_LT(error.rotation.max, 1e-7);
  EXPECT_GT(ate(estimate, reference, Alignment::se3).translation.rmse, 0.1);
}

TEST(AbsoluteTrajectoryError, Se3AlignmentNeverMirrors) {
  Trajectory mirrored = randomWalk(50, 6);
  const Trajectory reference = mirrored;
  for (auto& [stamp, pose] : mirrored) pose.translation.z() *= -1;
  const auto error = ate(mirrored, reference, Alignment::se3);
  EXPECT_NEAR(error.paired.reference_from_estimate.motion.rotation.toRotationMatrix().determinant(), 1, 1e-9);
  EXPECT_GT(error.translation.rmse, 0.1);
}

class AlignmentInvariance : public ::testing::TestWithParam<unsigned> {};

TEST_P(AlignmentInvariance, Se3ErrorDoesNotDependOnTheEstimatesWorld) {
  const Trajectory reference = randomWalk(80, GetParam());
  const Trajectory estimate = withNoise(reference, 0.2, GetParam() + 100);
  const Trajectory moved = inOtherWorld(someMotion(), estimate);
  for (const auto alignment : {Alignment::first, Alignment::se3, Alignment::sim3}) {
    const auto a = ate(estimate, reference, alignment), b = ate(moved, reference, alignment);
    EXPECT_NEAR(a.translation.rmse, b.translation.rmse, 1e-9);
    EXPECT_NEAR(a.translation.max, b.translation.max, 1e-9);
    EXPECT_NEAR(a.rotation.rmse, b.rotation.rmse, 1e-8);
  }
  EXPECT_GT(ate(moved, reference, Alignment::none).translation.rmse, 1);
}

TEST_P(AlignmentInvariance, YawErrorDoesNotDependOnTurnsAboutTheVertical) {
  const Trajectory reference = randomWalk(80, GetParam());
  const Trajectory estimate = withNoise(reference, 0.2, GetParam() + 100);
  const geometry::Se3 turned{geometry::expSo3({0, 0, 2.2}), {4, 5, 6}};
  EXPECT_NEAR(ate(estimate, reference, Alignment::yaw).translation.rmse,
              ate(inOtherWorld(turned, estimate), reference, Alignment::yaw).translation.rmse, 1e-9);
}

TEST_P(AlignmentInvariance, TheMoreIsFittedTheSmallerTheError) {
  const Trajectory reference = randomWalk(80, GetParam());
  const Trajectory estimate = withNoise(reference, 0.3, GetParam() + 200);
  double last = 1e300;
  for (const auto alignment : {Alignment::none, Alignment::yaw, Alignment::se3, Alignment::sim3}) {
    const double rmse = ate(estimate, reference, alignment).translation.rmse;
    EXPECT_LE(rmse, last + 1e-12);
    last = rmse;
  }
}

TEST_P(AlignmentInvariance, NoOtherMotionFitsBetter) {
  const Trajectory reference = randomWalk(40, GetParam());
  const auto best = ate(withNoise(reference, 0.3, GetParam() + 300), reference, Alignment::sim3);
  const auto rmseAfter = [&](const Similarity& more) {
    double sum = 0;
    for (const auto& pair : aligned(best.paired.pairs, more)) {
      sum += (pair.estimate.translation - pair.reference.translation).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(best.paired.pairs.size()));
  };
  EXPECT_NEAR(rmseAfter({}), best.translation.rmse, 1e-12);
  for (int k = 0; k < 6; ++k) {
    for (const double step : {-1e-3, 1e-3}) {
      geometry::Vector6d delta = geometry::Vector6d::Zero();
      delta[k] = step;
      EXPECT_GT(rmseAfter({1, plus(geometry::Se3{}, delta)}), best.translation.rmse);
      EXPECT_GT(rmseAfter({1 + step, {}}), best.translation.rmse);
    }
  }
}

TEST_P(AlignmentInvariance, EstimateAndReferenceMayChangePlacesUnderSe3) {
  const Trajectory reference = randomWalk(40, GetParam());
  const Trajectory estimate = withNoise(reference, 0.3, GetParam() + 400);
  EXPECT_NEAR(ate(estimate, reference, Alignment::se3).translation.rmse,
              ate(reference, estimate, Alignment::se3).translation.rmse, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AlignmentInvariance, ::testing::Range(1u, 9u));

TEST(AbsoluteTrajectoryError, OnALineTheFreeTurnIsTheSmallest) {
  // Both drive straight, the estimate along y: a quarter turn about z and none about the line of travel.
  Trajectory estimate, reference;
  for (int i = 0; i < 5; ++i) {
    estimate.push_back(planar(i, 100, i, 90 * kDegree));
    reference.push_back(planar(i, i, 0));
  }
  for (const auto alignment : {Alignment::yaw, Alignment::se3, Alignment::sim3}) {
    const auto error = ate(estimate, reference, alignment);
    EXPECT_LT(error.translation.max, 1e-9);
    EXPECT_LT(error.rotation.max, 1e-7);
  }
}

TEST(AbsoluteTrajectoryError, AStandingRobotIsNotTurned) {
  Trajectory estimate, reference;
  for (int i = 0; i < 5; ++i) {
    estimate.push_back(planar(i, 0.1, 1e6 / 3));
    reference.push_back(planar(i, 0.3, 7));
  }
  for (const auto alignment : {Alignment::yaw, Alignment::se3}) {
    const auto error = ate(estimate, reference, alignment);
    EXPECT_LT(error.translation.max, 1e-8);
    EXPECT_LT(error.rotation.max, 1e-12);
  }
  EXPECT_THROW(ate(estimate, reference, Alignment::sim3), base::Error);
}

TEST(AbsoluteTrajectoryError, AgainstAnInterpolatedReferenceNeedsNoCommonStamps) {
  // The reference drives 2 m/s; in the middle of its interval it was at 1 m, the estimate says 1.25.
  const Trajectory estimate = {planar(0.5, 1.25, 0)};
  const Trajectory reference = {planar(0, 0, 0), planar(1, 2, 0)};
  PairingOptions options;
  options.longest_gap = base::durationFromSeconds(1);
  EXPECT_NEAR(absoluteTrajectoryError(estimate, reference, options).translation.rmse, 0.25, 1e-9);
}

TEST(AbsoluteTrajectoryError, TrajectoriesWithoutCommonStampsAreRefusedWithTheirSpans) {
  try {
    ate({planar(0, 0, 0)}, {planar(5, 0, 0)}, Alignment::none);
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("1000000005.0"), std::string::npos) << error.what();
  }
  EXPECT_THROW(ate({}, {planar(5, 0, 0)}, Alignment::se3), base::Error);
}

TEST(Alignment, IsChosenByName) {
  EXPECT_EQ(alignmentNamed("none"), Alignment::none);
  EXPECT_EQ(alignmentNamed("sim3"), Alignment::sim3);
  try {
    alignmentNamed("SE3");
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::command_line);
    EXPECT_NE(std::string(error.what()).find("none | first | yaw | se3 | sim3"), std::string::npos);
  }
}

}  // namespace
}  // namespace omnimapper::eval::absolute_trajectory_error_test
