#include <gtest/gtest.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/geometry/Angle.h>

#include <set>

#include "PointDrive.h"

namespace omnimapper::plugins::point_landmarks_plugin_test {
namespace {

using geometry::kPi;
using testing::SimulatedLog;

std::set<std::string> refusals(const mapper::View& view) {
  std::set<std::string> reasons;
  for (const auto& decision : view.decisions)
    if (!decision.accepted) reasons.insert(decision.reason);
  return reasons;
}

TEST(PointLandmarksPlugin, OneDriveMapsEveryPointOnceWhereItIs) {
  const auto options = pointDrive();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kPointsIni);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  EXPECT_EQ(view.map.landmarks.size(), options.beacons.positions.size());
  EXPECT_LT(worstPoint(view, log, options.beacons.positions), 0.1);
  EXPECT_LT(testing::trajectoryError(view, log), 0.05);
  std::set<int> numbers;
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto& payload = payloadOf(landmark);
    EXPECT_TRUE(numbers.insert(payload.number).second) << "a point stands twice in the map";
    EXPECT_EQ(landmark.kind, "marker");
    EXPECT_EQ(payload.seen_by.at("beacons"), landmark.evidence);
    const auto shape = payload.shape({view.graph.value(landmark.variables.front())}, view.map.key_frames);
    EXPECT_EQ(shape.label, "marker " + std::to_string(payload.number));
    ASSERT_EQ(shape.points.size(), 1U);
    EXPECT_NEAR(shape.points.front().z(), 1.4, 0.02) << "a planar map keeps the height all the same";
  }
}

TEST(PointLandmarksPlugin, ASpatialMapHasPointsOfSpace) {
  const auto options = pointDrive();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kPointsIni, {"mapper.motion=spatial"});
  testing::run(*engine, log.observations());
  EXPECT_EQ(engine->view().map.landmarks.size(), options.beacons.positions.size());
  EXPECT_LT(worstPoint(engine->view(), log, options.beacons.positions), 0.15);
  EXPECT_LT(testing::trajectoryError(engine->view(), log), 0.1);
}

// The sensor is tilted and turned, which must have no effect on measurements over the floor.
TEST(PointLandmarksPlugin, ATiltedSensorMeasuresTheFloorAllTheSame) {
  auto options = pointDrive();
  options.beacons.tilt_reach = 0.4;
  options.beacons.pan_reach = 1;
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kPointsIni);
  testing::run(*engine, log.observations());
  EXPECT_LT(worstPoint(engine->view(), log, options.beacons.positions), 0.1);
}

TEST(PointLandmarksPlugin, PointsWithoutNumbersAreDistinguished) {
  const auto options = pointDrive();
  const SimulatedLog log(options);
  const auto engine = testing::makeEngine(kPointsIni);
  testing::run(*engine, changed(log, forgetNumbers));
  const auto view = engine->view();
  EXPECT_EQ(view.candidates("points").size(), options.beacons.positions.size());
  EXPECT_LT(worstPoint(view, log, options.beacons.positions), 0.15);
  EXPECT_LT(testing::trajectoryError(view, log), 0.1);
  EXPECT_EQ((*view.map.landmarks.begin()).second.kind, "point");
}

TEST(PointLandmarksPlugin, EveryMeasurementHasADecisionAndTrueOnesPassTheGate) {
  const SimulatedLog log(pointDrive());
  const auto engine = testing::makeEngine(kPointsIni);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  const auto refused = std::count_if(view.decisions.begin(), view.decisions.end(),
                                     [](const auto& decision) { return !decision.accepted; });
  EXPECT_EQ(view.decisions.size(), [&] {
    std::size_t measurements = 0;
    for (const auto& [id, factor] : view.graph.factors()) measurements += factor.tags.landmark.has_value();
    return measurements;
  }());
  EXPECT_GT(view.decisions.size(), 100U);
  EXPECT_LE(refused, static_cast<std::ptrdiff_t>(view.decisions.size() / 100));
}

TEST(PointLandmarksPlugin, AWrongNumberIsKeptWithoutWeight) {
  const auto options = pointDrive();
  const SimulatedLog log(options);
  std::set<int> seen;
  int swapped = 0;
  const auto observations = changed(log, [&](Measurements& measurements) {
    for (auto& measurement : measurements) {
      const int reported = measurement.landmarkID;
      if (++swapped % 10 == 0 && seen.size() > 2) measurement.landmarkID = *seen.begin();
      seen.insert(reported);
    }
  });
  const auto engine = testing::makeEngine(kPointsIni);
  testing::run(*engine, observations);
  const auto view = engine->view();
  std::size_t without_weight = 0;
  for (const auto& [id, factor] : view.graph.factors()) without_weight += factor.weight == 0;
  EXPECT_GT(without_weight, 5U);
  EXPECT_EQ(refusals(view).count("gated out: not where its landmark is; kept without weight"), 1U);
  EXPECT_LT(worstPoint(view, log, options.beacons.positions), 0.15);
}

TEST(PointLandmarksPlugin, WhatCannotBeUsedIsRefusedWithItsReason) {
  auto options = pointDrive();
  options.laps = 0.05;
  const SimulatedLog log(options);
  const auto observations = changed(log, [](Measurements& measurements) {
    if (measurements.empty()) return;
    const auto measurement = measurements.front();
    measurements.assign(6, measurement);  // the second has the number of the first
    for (int i = 2; i < 6; ++i) measurements[static_cast<std::size_t>(i)].landmarkID = 97 + i;
    measurements[2].range = 0;
    measurements[3].yaw = std::nanf("");
    measurements[4].pitch = static_cast<float>(kPi / 2);
    measurements[5].range = -1;
  });
  for (const std::string motion : {"planar", "spatial"}) {
    const auto engine = testing::makeEngine(kPointsIni, {"mapper.motion=" + motion});
    testing::run(*engine, observations);
    EXPECT_EQ(refusals(engine->view()),
              (std::set<std::string>{"its number occurs twice in the observation", "no finite range and bearing",
                                     "straight above or below the sensor, or without standard deviations"}))
        << motion;
    EXPECT_LE(engine->view().map.landmarks.size(), 2U) << motion;
  }
}

// One observation, of points behind and on all sides, with MRPT's signs of the angles.
TEST(PointLandmarksPlugin, ANewPointMayBeAnywhereAroundTheSensor) {
  auto options = pointDrive();
  options.laps = 0.02;
  options.beacons.base_from_head = {};
  const auto observations = changed(SimulatedLog(options), [](Measurements& measurements) {
    measurements.clear();
    for (int i = 0; i < 4; ++i) {
      mrpt::obs::CObservationBearingRange::TMeasurement measurement;
      measurement.range = 2;
      measurement.yaw = static_cast<float>(i * kPi / 2);
      measurement.pitch = -0.5F;
      measurement.landmarkID = i;
      measurements.push_back(measurement);
    }
  });
  const auto engine = testing::makeEngine(kPointsIni, {"mapper.motion=spatial", "trigger.distance_m=100"});
  testing::run(*engine, observations);
  const auto view = engine->view();
  ASSERT_EQ(view.map.landmarks.size(), 4U);
  const double flat = 2 * std::cos(0.5), up = 2 * std::sin(0.5);
  const Eigen::Vector3d expected[] = {{flat, 0, up}, {0, flat, up}, {-flat, 0, up}, {0, -flat, up}};
  for (const auto& [id, landmark] : view.map.landmarks) {
    const Eigen::Vector3d there = view.graph.value(landmark.variables.front());
    EXPECT_LT((there - expected[payloadOf(landmark).number]).norm(), 1e-3);
  }
}

TEST(PointLandmarksPlugin, SigmasAreTheObservationsUnlessConfigured) {
  auto options = pointDrive();
  options.laps = 0.1;
  const SimulatedLog log(options);
  const auto sigmasOf = [](const mapper::View& view) -> Eigen::VectorXd {
    for (const auto& [id, factor] : view.graph.factors())
      if (factor.tags.landmark) return factor.noise.covariance().diagonal().cwiseSqrt();
    return {};
  };
  const auto engine = testing::makeEngine(kPointsIni, {"mapper.motion=spatial"});
  testing::run(*engine, log.observations());
  EXPECT_LT((sigmasOf(engine->view()) - Eigen::Vector3d(0.02, 0.005, 0.005)).norm(), 1e-6);
  const auto configured = testing::makeEngine(
      kPointsIni, {"mapper.motion=spatial", "points.sigma_range_m=0.1", "points.sigma_pitch_deg=1"});
  testing::run(*configured, log.observations());
  EXPECT_LT((sigmasOf(configured->view()) - Eigen::Vector3d(0.1, 0.005, kPi / 180)).norm(), 1e-6);
  const auto observations = log.observations();
  for (const auto& observation : observations) {
    auto* seen = dynamic_cast<mrpt::obs::CObservationBearingRange*>(observation.get());
    if (!seen) continue;
    seen->validCovariances = true;
    for (auto& measurement : seen->sensedData) {
      measurement.covariance.setZero();
      for (int i = 0; i < 3; ++i) measurement.covariance(i, i) = 1e-4 * (i + 1);
    }
  }
  const auto own = testing::makeEngine(kPointsIni, {"mapper.motion=spatial"});
  testing::run(*own, observations);
  EXPECT_LT((sigmasOf(own->view()) - Eigen::Vector3d(0.01, std::sqrt(2e-4), std::sqrt(3e-4))).norm(), 1e-6);
}

TEST(PointLandmarksPlugin, AMapIsReadBackAndItsPointsAreKnownAgain) {
  auto options = pointDrive();
  const auto first = testing::makeEngine(kPointsIni);
  const SimulatedLog log(options);
  testing::run(*first, log.observations());
  options.seed = 2;
  options.laps = 0.4;
  const SimulatedLog second_log(options);
  const auto second = testing::makeEngine(kPointsIni);
  // The initial values are wrong by a metre and 20 degrees.
  second->sessions().continueFrom({first->view().map, first->view().graph}, {{0.8, -0.6, 0, 0.35, 0, 0}, 1, 0.5});
  testing::run(*second, second_log.observations());
  const auto view = second->view();
  ASSERT_EQ(view.map.sessions.size(), 2U);
  EXPECT_TRUE(view.map.sessions.back().aligned);
  EXPECT_EQ(view.map.landmarks.size(), options.beacons.positions.size()) << "each point is one landmark of both";
  EXPECT_LT(worstPoint(view, log, options.beacons.positions), 0.15);
}

TEST(PointPayload, ComesBackFromBytes) {
  map::PayloadRegistry registry;
  PointPayload::addTo(registry);
  const auto written = PointPayload().with("a", 1)->with("b", 2)->with("a", 3);
  std::ostringstream out;
  written->write(out);
  const auto read = registry.read("point", out.str());
  const auto& back = dynamic_cast<const PointPayload&>(*read);
  EXPECT_EQ(back.number, -1);
  EXPECT_EQ(back.label(), "point");
  EXPECT_DOUBLE_EQ(back.height, 2);
  EXPECT_EQ(back.seen_by, written->seen_by);
}

// As when a landmark was found to have moved.
TEST(PointLandmarksPlugin, ANumberWhoseLandmarkIsRetiredMakesANewOne) {
  auto options = pointDrive();
  options.laps = 0.3;
  const SimulatedLog log(options);
  const auto first = testing::makeEngine(kPointsIni);
  testing::run(*first, log.observations());
  map::Map map = first->view().map;
  const auto before = map.landmarks.size();
  std::vector<base::LandmarkId> ids;
  for (const auto& [id, landmark] : map.landmarks) ids.push_back(id);
  for (const auto id : ids) map.landmarks.edit(id)->state = map::Landmark::State::retired;
  const auto second = testing::makeEngine(kPointsIni);
  second->sessions().continueFrom({map, first->view().graph}, {{0, 0, 0, 0, 0, 0}, 0.01, 0.01});
  testing::run(*second, log.observations());
  EXPECT_EQ(second->view().map.landmarks.size(), 2 * before);
}

}  // namespace
}  // namespace omnimapper::plugins::point_landmarks_plugin_test
