#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <cmath>
#include <limits>

#include "wheel_odometry/OdometryPlugin.h"

namespace omnimapper::plugins::odometry_plugin_test {
namespace {

using mapper::PosePlugin;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using Taken = PosePlugin::Taken;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

mrpt::obs::CObservationOdometry::Ptr reading(double seconds, const CPose2D& pose, const std::string& label = "wheels") {
  const auto made = mrpt::obs::CObservationOdometry::Create();
  made->timestamp = at(seconds);
  made->sensorLabel = label;
  made->odometry = pose;
  return made;
}

obs::CObservationRelativeMotion::Ptr action(double begin, double end, const CPose3D& motion,
                                            const std::string& label = "wheels") {
  const auto made = obs::CObservationRelativeMotion::Create();
  made->begin = at(begin);
  made->timestamp = at(end);
  made->sensorLabel = label;
  made->begin_from_end = motion;
  return made;
}

OdometryOptions roundNoise() {
  OdometryOptions options;
  options.position_noise_per_root_m = 0.1;
  options.yaw_noise_per_root_turn = 0.2;
  options.yaw_noise_per_root_m = 0.05;
  options.position_noise_per_root_s = 0.01;
  options.yaw_noise_per_root_s = 0.02;
  return options;
}

TEST(OdometryPlugin, MotionIsTheDifferenceOfCumulativePosesInTheEarlierBase) {
  OdometryPlugin plugin(roundNoise());
  EXPECT_FALSE(plugin.coveredUntil());
  EXPECT_EQ(plugin.add(reading(0, {5, 5, kPi / 2})), Taken::taken);
  EXPECT_FALSE(plugin.coveredUntil()) << "one reading is no motion";
  EXPECT_EQ(plugin.add(reading(2, {4, 8, kPi})), Taken::taken);
  EXPECT_EQ(plugin.coveredUntil(), at(2));
  const auto motion = plugin.between(at(0), at(2));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.x(), 3, 1e-12);  // it looked along y
  EXPECT_NEAR(motion->begin_from_end.y(), 1, 1e-12);
  EXPECT_NEAR(motion->begin_from_end.yaw(), kPi / 2, 1e-12);
  EXPECT_FALSE(plugin.isFallback());
  OdometryOptions fallback;
  fallback.fallback = true;
  EXPECT_TRUE(OdometryPlugin(fallback).isFallback()) << "where the INI says so";
}

TEST(OdometryPlugin, VarianceGrowsWithTravelTurnAndTimeAsComputedByHand) {
  OdometryPlugin plugin(roundNoise());
  plugin.add(reading(0, {0, 0, 0}));
  plugin.add(reading(2, {1, 0, 0}));     // 1 m in 2 s
  plugin.add(reading(3, {1, 0, -1.5}));  // 1.5 rad in 1 s
  const auto straight = plugin.between(at(0), at(2)), turn = plugin.between(at(2), at(3));
  ASSERT_TRUE(straight && turn);
  EXPECT_NEAR(straight->covariance(0, 0), 0.01 * 1 + 0.0001 * 2, 1e-12);
  EXPECT_NEAR(straight->covariance(1, 1), 0.01 * 1 + 0.0001 * 2, 1e-12);
  EXPECT_NEAR(straight->covariance(5, 5), 0.0025 * 1 + 0.0004 * 2, 1e-12);
  EXPECT_NEAR(turn->covariance(0, 0), 0.0001 * 1, 1e-12);
  EXPECT_NEAR(turn->covariance(5, 5), 0.04 * 1.5 + 0.0004 * 1, 1e-12);
  const auto both = plugin.between(at(0), at(3));
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->covariance(5, 5), straight->covariance(5, 5) + turn->covariance(5, 5), 1e-12);
}

TEST(OdometryPlugin, ActionsFollowOneAnother) {
  OdometryPlugin plugin(roundNoise());
  EXPECT_EQ(plugin.add(action(0, 1, CPose3D(1, 0, 0, kPi / 2, 0, 0))), Taken::taken);
  EXPECT_EQ(plugin.add(action(1, 2, CPose3D(2, 0, 0, 0, 0, 0))), Taken::taken);
  const auto motion = plugin.between(at(0), at(2));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->begin_from_end.x(), 1, 1e-12);
  EXPECT_NEAR(motion->begin_from_end.y(), 2, 1e-12);
}

TEST(OdometryPlugin, TheCovarianceOfAnActionCountsOnlyWhereTheUserSaysSo) {
  for (const bool reported : {false, true}) {
    auto options = roundNoise();
    options.use_reported_covariance = reported;
    OdometryPlugin plugin(options);
    auto made = action(0, 1, CPose3D(1, 0, 0, 0, 0, 0));
    made->covariance.diagonal() << 7, 8, 0, 0, 0, 9;
    plugin.add(made);
    const auto motion = plugin.between(at(0), at(1));
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->covariance(0, 0), reported ? 7 : 0.0101, 1e-12);
    EXPECT_NEAR(motion->covariance(5, 5), reported ? 9 : 0.0029, 1e-12);
  }
}

TEST(OdometryPlugin, WhatIsNotFiniteIsRefusedAndTheNextReadingMakesUpForIt) {
  OdometryPlugin plugin(roundNoise());
  plugin.add(reading(0, {0, 0, 0}));
  EXPECT_EQ(plugin.add(reading(1, {kNan, 0, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(1.1, {0, kInf, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(1.2, {0, 0, kNan})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(2, {1, 0, 0})), Taken::taken);
  EXPECT_NEAR(plugin.between(at(0), at(2))->begin_from_end.x(), 1, 1e-12);
  EXPECT_EQ(plugin.add(action(2, 3, CPose3D(kNan, 0, 0, 0, 0, 0))), Taken::unusable);
  EXPECT_EQ(plugin.coveredUntil(), at(2));
}

TEST(OdometryPlugin, TimeThatStandsStillOrRunsBackwardsIsRefused) {
  OdometryPlugin plugin(roundNoise());
  plugin.add(reading(1, {0, 0, 0}));
  plugin.add(reading(2, {1, 0, 0}));
  EXPECT_EQ(plugin.add(reading(2, {9, 0, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(1.5, {9, 0, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(3, {2, 0, 0})), Taken::taken);
  EXPECT_NEAR(plugin.between(at(1), at(3))->begin_from_end.x(), 2, 1e-12);

  OdometryPlugin actions(roundNoise());
  actions.add(action(0, 1, CPose3D()));
  EXPECT_EQ(actions.add(action(0.5, 1.5, CPose3D())), Taken::unusable) << "overlaps";
  EXPECT_EQ(actions.add(action(1.5, 1.5, CPose3D())), Taken::unusable) << "no time";
  EXPECT_EQ(actions.add(action(2, 1.5, CPose3D())), Taken::unusable) << "backwards";
}

TEST(OdometryPlugin, AMotionThatNoBaseCanMakeIsNotReturned) {
  OdometryPlugin plugin(roundNoise());
  plugin.add(reading(0, {0, 0, 0}));
  plugin.add(reading(1, {1, 0, 0}));
  plugin.add(reading(2, {1e12, 0, 0}));
  plugin.add(reading(3, {1e12 + 2, 0, 0}));
  EXPECT_TRUE(plugin.between(at(0), at(1)));
  EXPECT_FALSE(plugin.between(at(1), at(2)));
  const auto after = plugin.between(at(2), at(3));
  ASSERT_TRUE(after) << "it continues from there";
  EXPECT_NEAR(after->begin_from_end.x(), 2, 1e-3);
  ASSERT_EQ(plugin.warnings().size(), 1U);
  EXPECT_NE(plugin.warnings().front().find("1e+12"), std::string::npos) << plugin.warnings().front();
  OdometryPlugin by_actions(roundNoise());
  EXPECT_EQ(by_actions.add(action(0, 1, CPose3D(109, 0, 0, 0, 0, 0))), Taken::taken);
  EXPECT_EQ(by_actions.add(action(1, 2, CPose3D(111, 0, 0, 0, 0, 0))), Taken::unusable);
}

TEST(OdometryPlugin, OneStampFromTheFutureIsRefusedAndALeapOfTheLogIsNot) {
  OdometryPlugin plugin(roundNoise());
  plugin.add(reading(0, {0, 0, 0}));
  EXPECT_EQ(plugin.add(reading(1e8, {1, 0, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(1, {1, 0, 0})), Taken::taken) << "all later ones would have come too late";
  EXPECT_NEAR(plugin.between(at(0), at(1))->begin_from_end.x(), 1, 1e-12);
  // The recording paused for an hour: the first reading after it waits for the second to agree.
  EXPECT_EQ(plugin.add(reading(3600, {2, 0, 0})), Taken::unusable);
  EXPECT_EQ(plugin.add(reading(3600.1, {3, 0, 0})), Taken::taken);
  EXPECT_EQ(plugin.add(reading(3600.2, {4, 0, 0})), Taken::taken);
  EXPECT_EQ(plugin.coveredUntil(), at(3600.2));
}

TEST(OdometryPlugin, TakesItsOwnLabelOrTheFirstThatComes) {
  OdometryPlugin first(roundNoise());
  EXPECT_EQ(first.add(reading(0, {}, "left")), Taken::taken);
  EXPECT_EQ(first.add(reading(0, {}, "right")), Taken::not_mine);
  EXPECT_EQ(first.add(mrpt::obs::CObservationComment::Create()), Taken::not_mine);
  auto options = roundNoise();
  options.label = "right";
  OdometryPlugin named(options);
  EXPECT_EQ(named.add(reading(0, {}, "left")), Taken::not_mine);
  EXPECT_EQ(named.add(reading(0, {}, "right")), Taken::taken);
}

}  // namespace
}  // namespace omnimapper::plugins::odometry_plugin_test
