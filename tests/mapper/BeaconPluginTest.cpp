// Runs the plugin of doc/add_a_landmark_type.md on a simulated drive.
#include <BeaconPlugin.h>
#include <gtest/gtest.h>

#include <set>

#include "BeaconDrive.h"

namespace beacons {
namespace beacon_plugin_test {
namespace {

using mrpt::obs::CObservationBearingRange;
using omnimapper::testing::SimulatedLog;
namespace mapper = omnimapper::mapper;
namespace testing = omnimapper::testing;

TEST(BeaconPlugin, OneDriveMapsEveryBeaconOnceWhereItIs) {
  const auto options = drive();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kBeaconIni);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  EXPECT_EQ(view.map.landmarks.size(), options.beacons.positions.size());
  EXPECT_LT(worstBeacon(view, log, options), 0.1);
  EXPECT_LT(testing::trajectoryError(view, log), 0.05);
  std::set<int> numbers;
  for (const auto& [id, landmark] : view.map.landmarks) {
    EXPECT_TRUE(numbers.insert(payloadOf(landmark).number).second) << "a beacon is in the map twice";
    EXPECT_EQ(landmark.kind, "beacon");
    EXPECT_EQ(landmark.owner, "beacons");
    EXPECT_EQ(landmark.evidence, view.factorsOf(id).size()) << "every measurement is evidence";
    EXPECT_LE(payloadOf(landmark).nearest, payloadOf(landmark).farthest);
  }
}

TEST(BeaconPlugin, ASpatialMapTakesTheSameFactors) {
  const auto options = drive();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kBeaconIni, {"mapper.motion=spatial"});
  testing::run(*engine, log.observations());
  EXPECT_EQ(engine->view().map.landmarks.size(), options.beacons.positions.size());
  EXPECT_LT(worstBeacon(engine->view(), log, options), 0.15);
  EXPECT_LT(testing::trajectoryError(engine->view(), log), 0.1);
}

TEST(BeaconPlugin, EveryMeasurementHasADecisionAndTrueOnesPassTheGate) {
  const SimulatedLog log(drive());
  const auto engine = testing::makeEngine(kBeaconIni);
  testing::run(*engine, log.observations());
  std::size_t measurements = 0, refused = 0;
  for (const auto& frame : engine->view().map.key_frames) {
    for (const auto& observation : frame.observations) {
      const auto* seen = dynamic_cast<const CObservationBearingRange*>(observation.get());
      measurements += seen ? seen->sensedData.size() : 0;
    }
  }
  for (const auto& decision : engine->view().decisions) {
    refused += !decision.accepted;
    EXPECT_FALSE(decision.reason.empty());
  }
  EXPECT_GT(measurements, 100U);
  EXPECT_EQ(engine->view().decisions.size(), measurements);
  EXPECT_LE(refused, measurements / 100);
}

TEST(BeaconPlugin, AWrongNumberIsGatedOutAndSaysSo) {
  const auto options = drive();
  const SimulatedLog log(options);
  const auto observations = log.observations();
  std::set<int> seen;
  int swapped = 0;
  for (const auto& observation : observations) {
    auto* measurements = dynamic_cast<CObservationBearingRange*>(observation.get());
    if (!measurements) continue;
    for (auto& measurement : measurements->sensedData) {
      if (++swapped % 10 == 0 && seen.size() > 2) measurement.landmarkID = *seen.begin();
      seen.insert(measurement.landmarkID);
    }
  }
  const auto engine = testing::makeEngine(kBeaconIni);
  testing::run(*engine, observations);
  const auto& decisions = engine->view().decisions;
  const auto gated = std::count_if(decisions.begin(), decisions.end(), [](const auto& decision) {
    return !decision.accepted && decision.reason.find("gated out") == 0;
  });
  EXPECT_GT(gated, 5);
  EXPECT_LT(worstBeacon(engine->view(), log, options), 0.15);
}

TEST(BeaconPlugin, WhatCannotBeUsedIsRefusedWithItsReason) {
  auto options = drive();
  options.laps = 0.05;
  const auto observations = SimulatedLog(options).observations();
  for (const auto& observation : observations) {
    auto* measurements = dynamic_cast<CObservationBearingRange*>(observation.get());
    if (!measurements || measurements->sensedData.empty()) continue;
    auto measurement = measurements->sensedData.front();
    measurements->sensedData.assign(4, measurement);  // the second has the number of the first
    measurements->sensedData[2].landmarkID = -1;
    measurements->sensedData[3].landmarkID = 99;
    measurements->sensedData[3].range = 0.1F;  // the beacons hang higher than that
  }
  const auto engine = testing::makeEngine(kBeaconIni);
  testing::run(*engine, observations);
  std::set<std::string> reasons;
  for (const auto& decision : engine->view().decisions) {
    if (!decision.accepted) reasons.insert(decision.reason);
  }
  EXPECT_EQ(reasons, (std::set<std::string>{"its number occurs twice in the observation", "it reports no number",
                                            "the range does not reach to the height of the beacons"}));
}

TEST(BeaconPlugin, ANewOneKnowsTheBeaconsOfAMapThatIsContinued) {
  auto options = drive();
  options.laps = 0.2;
  const auto engine = testing::makeEngine(kBeaconIni);
  testing::run(*engine, SimulatedLog(options).observations());
  const auto view = engine->view();
  const auto& frame = view.map.key_frames.back();
  ASSERT_FALSE(frame.observations.empty());
  mapper::PluginContext context;
  context.section = "beacons";
  BeaconOptions beacon_options;
  beacon_options.height = 1.4;
  BeaconPlugin fresh(beacon_options, context), restored(beacon_options, context);
  restored.restore(nullptr, view);
  const mapper::Observed observed{*frame.observations.front(), nullptr};
  EXPECT_FALSE(fresh.measure(frame, observed, view).addedLandmarks().empty());
  const auto batch = restored.measure(frame, observed, view);
  EXPECT_TRUE(batch.addedLandmarks().empty());
  EXPECT_FALSE(batch.evidence().empty());
}

TEST(BeaconPlugin, ASessionFindsItsPlaceInTheMapByTheBeaconsItSeesAgain) {
  auto options = drive();
  const auto first = testing::makeEngine(kBeaconIni);
  const SimulatedLog log(options);
  testing::run(*first, log.observations());
  options.seed = 2;
  options.laps = 0.4;
  const SimulatedLog second_log(options);
  const auto second = testing::makeEngine(kBeaconIni);
  // The initial guess is wrong by a metre and 20 degrees.
  second->sessions().continueFrom({first->view().map, first->view().graph}, {{0.8, -0.6, 0, 0.35, 0, 0}, 1, 0.5});
  testing::run(*second, second_log.observations());
  const auto view = second->view();
  ASSERT_EQ(view.map.sessions.size(), 2U);
  EXPECT_TRUE(view.map.sessions.back().aligned);
  EXPECT_EQ(view.map.landmarks.size(), options.beacons.positions.size()) << "each beacon is one landmark of both";
  EXPECT_LT(worstBeacon(view, log, options), 0.15);
  for (const auto& frame : view.map.key_frames) {
    if (frame.id.session == 0) continue;
    const mrpt::poses::CPose3D truth(second_log.truthAt(frame.stamp));
    EXPECT_LT((frame.map_from_base.translation() - truth.translation()).norm(), 0.15) << frame.id;
  }
}

}  // namespace
}  // namespace beacon_plugin_test
}  // namespace beacons
