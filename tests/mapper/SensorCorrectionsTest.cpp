// Uses the plugin of doc/add_a_landmark_type.md, which estimates corrections of sensor poses.
#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <cmath>

#include "BeaconDrive.h"

namespace beacons {
namespace sensor_corrections_test {
namespace {

using Eigen::Vector3d;
using mrpt::obs::CObservationBearingRange;
using mrpt::poses::CPose3D;
using omnimapper::testing::SimulatedLog;
using omnimapper::testing::SimulatedLogOptions;
namespace base = omnimapper::base;
namespace geometry = omnimapper::geometry;
namespace graph = omnimapper::graph;
namespace mapper = omnimapper::mapper;
namespace testing = omnimapper::testing;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

// A pan-tilt head that swings, with a sensor that is mounted with an unknown rotation.
SimulatedLogOptions panTilt() {
  auto options = drive();
  options.yaw_drift_per_m = 0;
  options.travel_scale = 1;
  options.beacons.pan_reach = 1.2;
  options.beacons.tilt_reach = 0.3;
  options.beacons.reported_from_sensor = CPose3D(0, 0, 0, 4 * kDegree, -2 * kDegree, 0);
  return options;
}

// The corrections that a run estimated.
std::vector<geometry::Vector6d> corrections(const mapper::View& view) {
  std::vector<geometry::Vector6d> all;
  for (const auto& [id, record] : view.graph.variables()) {
    if (record.kind->kind() != "se3") continue;
    all.push_back(minus(graph::se3FromValue(record.value.data()), geometry::Se3()));
  }
  return all;
}

TEST(SensorCorrections, OneForTheRunFindsHowTheSensorIsMounted) {
  const auto options = panTilt();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(
      kBeaconIni,
      {"beacons.estimate_sensor_pose=once", "beacons.sensor_pose_sigma_m=0.01", "beacons.sensor_pose_sigma_deg=5"});
  testing::run(*engine, log.observations());
  const auto found = corrections(engine->view());
  ASSERT_EQ(found.size(), 1U);
  const auto truth = minus(geometry::fromMrpt(options.beacons.reported_from_sensor), geometry::Se3());
  base::VariableId id;
  for (const auto& [variable, record] : engine->view().graph.variables()) {
    if (record.kind->kind() == "se3") id = variable;
  }
  const auto covariance = engine->view().jointCovariance({id});
  ASSERT_TRUE(covariance);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_NEAR(found[0][axis], truth[axis], 3 * std::sqrt((*covariance)(axis, axis))) << "axis " << axis;
  }
  EXPECT_LT(std::sqrt((*covariance)(5, 5)), 0.5 * kDegree) << "the pan is not determined by the prior alone";
  EXPECT_LT(std::sqrt((*covariance)(4, 4)), 0.5 * kDegree) << "nor the tilt";
  EXPECT_LT(worstBeacon(engine->view(), log, options), 0.3);
}

TEST(SensorCorrections, TakenAsGivenTheSameErrorDistortsTheMap) {
  const auto options = panTilt();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(
      kBeaconIni, {"beacons.association_confidence=0.999999999", "beacons.association_inflation=100"});
  testing::run(*engine, log.observations());
  EXPECT_TRUE(corrections(engine->view()).empty());
  EXPECT_GT(worstBeacon(engine->view(), log, options), 1);
}

TEST(SensorCorrections, OneForEachKeyFrameStaysWithinItsPrior) {
  const auto options = panTilt();
  const SimulatedLog log(options);
  const auto engine =
      testing::makeEngine(kBeaconIni, {"beacons.estimate_sensor_pose=each_key_frame",
                                       "beacons.sensor_pose_sigma_m=0.01", "beacons.sensor_pose_sigma_deg=2"});
  testing::run(*engine, log.observations());
  const auto found = corrections(engine->view());
  std::size_t seeing = 0;
  for (const auto& frame : engine->view().map.key_frames) {
    seeing += std::any_of(frame.observations.begin(), frame.observations.end(), [](const auto& observation) {
      const auto* measurements = dynamic_cast<const CObservationBearingRange*>(observation.get());
      return measurements && !measurements->sensedData.empty();
    });
  }
  EXPECT_EQ(found.size(), seeing);
  Vector3d mean = Vector3d::Zero();
  for (const auto& correction : found) {
    EXPECT_LT(correction.head<3>().norm(), 3 * 0.01);
    EXPECT_LT(correction.tail<3>().norm(), 3 * 2 * kDegree);
    mean += correction.tail<3>() / static_cast<double>(found.size());
  }
  EXPECT_LT(mean.y(), -1 * kDegree) << "each of them sees the tilt";
}

TEST(SensorCorrections, AreMadeOnceForEachSensorAndBoundByTheirFinalIds) {
  mapper::SensorPoseTrust trust;
  trust.estimate = mapper::SensorPoseTrust::Estimate::each_key_frame;
  mapper::SensorCorrections corrections(trust, "mine");
  mapper::Batch batch;
  const auto a = corrections.find("a", {0, 1}, batch), b = corrections.find("b", {0, 1}, batch);
  ASSERT_TRUE(a && b);
  EXPECT_NE(*a, *b);
  EXPECT_EQ(corrections.find("a", {0, 1}, batch), a);
  EXPECT_EQ(batch.addedVariables().size(), 2U);
  EXPECT_EQ(batch.addedFactors().size(), 2U) << "a prior each";
  EXPECT_EQ(batch.addedFactors()[0].tags.owner, "mine");
  corrections.applied({{{0, 40}, {0, 41}}, {}, {}});
  mapper::Batch next;
  EXPECT_EQ(corrections.find("b", {0, 1}, next), (base::VariableId{0, 41}));
  EXPECT_TRUE(next.empty());
  EXPECT_NE(corrections.find("b", {0, 2}, next), (base::VariableId{0, 41}));

  trust.estimate = mapper::SensorPoseTrust::Estimate::no;
  mapper::SensorCorrections none(trust, "mine");
  EXPECT_FALSE(none.find("a", {0, 1}, next));
  EXPECT_TRUE(none.priorCovariance().isZero());
}

}  // namespace
}  // namespace sensor_corrections_test
}  // namespace beacons
