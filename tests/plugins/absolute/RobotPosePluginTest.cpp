#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <limits>

#include "absolute/RobotPosePlugin.h"

namespace omnimapper::plugins::robot_pose_plugin_test {
namespace {

using mrpt::poses::CPose3D;

constexpr double kPi = 3.14159265358979323846;

const std::string kTrackerIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = tracker
[odometry]
class = OdometryPlugin
[tracker]
class = RobotPosePlugin
)";

testing::SimulatedLogOptions tracked(const CPose3D& reference_from_map) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  options.lasers.clear();
  options.tracker.on = true;
  options.tracker.reference_from_map = reference_from_map;
  return options;
}

mrpt::obs::CObservationRobotPose measured(const CPose3D& pose, const CPose3D& base_from_body = {}) {
  mrpt::obs::CObservationRobotPose made;
  made.timestamp = base::stampFromUnix(1'000'000'000);
  made.pose.mean = pose;
  made.sensorPose = base_from_body;
  return made;
}

class RobotPoseAnywhere : public ::testing::TestWithParam<double> {};

// Poses in the map frame place the whole trajectory, whatever the pose is at which the robot starts.
TEST_P(RobotPoseAnywhere, PosesInTheMapPlaceTheTrajectory) {
  const CPose3D start(30, -20, 0, GetParam(), 0, 0);
  const testing::SimulatedLog log(tracked(start));
  const auto engine = testing::makeEngine(kTrackerIni);
  testing::run(*engine, log.observations());
  const auto& frames = engine->view().map.key_frames;
  ASSERT_GT(frames.size(), 15U);
  for (const auto& frame : frames) {
    const CPose3D error = frame.map_from_base - (start + CPose3D(log.truthAt(frame.stamp)));
    EXPECT_LT(error.translation().norm(), 0.03);
    EXPECT_LT(std::abs(error.yaw()), 0.02);
  }
}

TEST_P(RobotPoseAnywhere, WhereTheirFrameIsUnknownItsPlaceInTheMapIsFound) {
  const CPose3D reference_from_start(30, -20, 0, GetParam(), 0, 0);
  const testing::SimulatedLog log(tracked(reference_from_start));
  const auto engine = testing::makeEngine(kTrackerIni, {"tracker.reference_is_map=false"});
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  const auto& frames = view.map.key_frames;
  ASSERT_GT(frames.size(), 15U);
  EXPECT_EQ(frames.front().map_from_base, CPose3D()) << "the map begins where the robot does";
  ASSERT_EQ(view.graph.variables().size(), frames.size() + 1);
  for (const auto& [id, record] : view.graph.variables()) {
    if (std::any_of(frames.begin(), frames.end(), [id = id](const auto& frame) { return frame.pose == id; })) continue;
    const CPose3D map_from_start = -CPose3D(log.truthAt(frames.front().stamp));
    const CPose3D error = mapper::poseOf(view.graph, id) - (map_from_start + (-reference_from_start));
    EXPECT_LT(error.translation().norm(), 0.15) << "30 m away";
    EXPECT_LT(std::abs(error.yaw()), 0.005);
  }
  EXPECT_LT(testing::trajectoryError(view, log), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Headings, RobotPoseAnywhere, ::testing::Values(0.0, 1.1, -2.0, 3.1));

TEST(RobotPosePlugin, TheTrackedBodyIsTakenBackToTheBase) {
  RobotPosePlugin plugin({}, {});
  testing::HandMadeRun run;
  // The body sits 1 m left of the base and looks along its y. It is seen at (5, 3), looking along the map's x:
  // so the base looks along -y, its left is the map's +x, and it stands at (4, 3).
  const auto batch = plugin.measure(
      run.addFrame({}), {measured(CPose3D(5, 3, 0, 0, 0, 0), CPose3D(0, 1, 0, kPi / 2, 0, 0)), nullptr}, run.view());
  ASSERT_EQ(batch.addedFactors().size(), 1U);
  const auto& prior = dynamic_cast<const graph::PriorSe2&>(*batch.addedFactors().front().factor).measured();
  EXPECT_NEAR(prior.x, 4, 1e-12);
  EXPECT_NEAR(prior.y, 3, 1e-12);
  EXPECT_NEAR(prior.yaw, -kPi / 2, 1e-12);
}

TEST(RobotPosePlugin, AReportedCovarianceIsTakenToTheBaseTooElseThatOfTheOptionsHolds) {
  RobotPoseOptions options;
  options.position_sigma = 0.3;
  options.angle_sigma = 0.2;
  RobotPosePlugin plugin(options, {});
  testing::HandMadeRun run;
  auto observation = measured(CPose3D(), CPose3D(2, 0, 0, 0, 0, 0));  // the body is 2 m ahead of the base
  const auto covariance = [&](const mapper::Batch& batch) { return batch.addedFactors().front().noise.covariance(); };
  const auto from_options = covariance(plugin.measure(run.addFrame({}), {observation, nullptr}, run.view()));
  EXPECT_NEAR(from_options(0, 0), 0.09, 1e-9);
  EXPECT_NEAR(from_options(2, 2), 0.04, 1e-9);
  observation.pose.cov.setZero();
  observation.pose.cov(0, 0) = observation.pose.cov(1, 1) = 0.25;
  observation.pose.cov(3, 3) = 0.01;  // yaw, in MRPT's order
  const auto reported = covariance(plugin.measure(run.addFrame({}), {observation, nullptr}, run.view()));
  EXPECT_NEAR(reported(0, 0), 0.25, 1e-9);
  EXPECT_NEAR(reported(1, 1), 0.25 + 4 * 0.01, 1e-9) << "a lever of 2 m swings the base";
  EXPECT_NEAR(reported(2, 2), 0.01, 1e-9);
}

TEST(RobotPosePlugin, WhatIsNotFiniteIsRefusedWithTheReason) {
  RobotPosePlugin plugin({}, {});
  testing::HandMadeRun run;
  const auto observation = measured(CPose3D(std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0));
  const auto batch = plugin.measure(run.addFrame({}), {observation, nullptr}, run.view());
  EXPECT_TRUE(batch.addedFactors().empty());
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_FALSE(batch.decisions().front().accepted);
  EXPECT_EQ(batch.decisions().front().reason, "not finite");
}

// One given pose is 0.3 m off its pose in the map: 3 of its standard deviations, or 15.
TEST(RobotPosePlugin, SaysHowFarTheMapIsFromTheGivenPoses) {
  for (const double sigma : {0.1, 0.02}) {
    RobotPoseOptions options;
    options.position_sigma = sigma;
    RobotPosePlugin plugin(options, {});
    testing::HandMadeRun run;
    EXPECT_TRUE(plugin.evidence(run.view()).empty()) << "nothing was given";
    plugin.measure(run.addFrame({}), {measured(CPose3D()), nullptr}, run.view());
    plugin.measure(run.addFrame(CPose3D(1, 0, 0, 0, 0, 0)), {measured(CPose3D(1, 0.3, 0, 0, 0, 0)), nullptr},
                   run.view());
    const auto evidence = plugin.evidence(run.view());
    ASSERT_EQ(evidence.size(), 1U);
    EXPECT_NEAR(evidence[0].value, 0.3 / sigma, 1e-6);
    EXPECT_EQ(evidence[0].says == mapper::Evidence::Says::against_it, sigma < 0.05) << evidence[0].reason;
  }
}

// Of 2,000 poses with correct covariances, one may be 5.5 standard deviations off. Of two, none is.
TEST(RobotPosePlugin, TheLargestOfManyErrorsIsJudgedAsTheLargestOfMany) {
  for (const int count : {2, 2000}) {
    RobotPoseOptions options;
    options.position_sigma = 0.01;
    RobotPosePlugin plugin(options, {});
    testing::HandMadeRun run;
    for (int i = 0; i < count; ++i) {
      const CPose3D pose(i, 0, 0, 0, 0, 0), given(i, i == 0 ? 0.055 : 0, 0, 0, 0, 0);
      plugin.measure(run.addFrame(pose), {measured(given), nullptr}, run.view());
    }
    const auto evidence = plugin.evidence(run.view());
    ASSERT_EQ(evidence.size(), 1U);
    EXPECT_NEAR(evidence[0].value, 5.5, 1e-6);
    EXPECT_EQ(evidence[0].says == mapper::Evidence::Says::against_it, count == 2) << evidence[0].reason;
  }
}

TEST(RobotPosePlugin, PosesAreTrustedUnlessALossIsSet) {
  for (const double scale : {0.0, 3.0}) {
    RobotPoseOptions options;
    options.loss_scale = scale;
    RobotPosePlugin plugin(options, {});
    testing::HandMadeRun run;
    const auto batch = plugin.measure(run.addFrame({}), {measured(CPose3D()), nullptr}, run.view());
    EXPECT_EQ(batch.addedFactors().front().loss.kind(),
              scale == 0 ? graph::Loss::Kind::none : graph::Loss::Kind::cauchy);
  }
}

TEST(RobotPosePlugin, WantsItsLabelOnly) {
  RobotPoseOptions options;
  EXPECT_TRUE(RobotPosePlugin(options, {}).wants(measured({})));
  options.label = "mocap";
  EXPECT_FALSE(RobotPosePlugin(options, {}).wants(measured({})));
}

}  // namespace
}  // namespace omnimapper::plugins::robot_pose_plugin_test
