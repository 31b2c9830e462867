#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "wheel_odometry/OdometryPlugin.h"

namespace omnimapper::mapper::engine_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using testing::kLaserIni;
using testing::makeEngine;
using testing::SimulatedLog;
using testing::SimulatedLogOptions;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

// A map of one lap of the box; the odometry is also passed to a separate plugin.
class Engine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    const SimulatedLog log(options);
    observations_ = log.observations();
    engine_ = makeEngine(kLaserIni, {"mapper.pose_plugins=odometry, no_motion"});
    testing::run(*engine_, observations_);
    odometry_ = std::make_unique<plugins::OdometryPlugin>(plugins::OdometryOptions{});
    for (const auto& observation : observations_) odometry_->add(observation);
  }
  static void TearDownTestSuite() {
    engine_.reset();
    odometry_.reset();
    observations_.clear();
  }

  static const map::KeyFrames& frames() { return engine_->view().map.key_frames; }
  static std::vector<base::Stamp> scanStamps() {
    std::vector<base::Stamp> stamps;
    for (const auto& o : observations_) {
      if (IS_CLASS(*o, CObservation2DRangeScan)) stamps.push_back(o->timestamp);
    }
    return stamps;
  }
  static bool isFar(const mrpt::poses::CPose3D& motion) {
    return motion.translation().norm() >= 0.4 || std::abs(motion.yaw()) >= 20 * kDegree;
  }

  static inline std::vector<CObservation::Ptr> observations_;
  static inline std::unique_ptr<mapper::Engine> engine_;
  static inline std::unique_ptr<plugins::OdometryPlugin> odometry_;
};

TEST_F(Engine, KeyFramesAreTheFirstScansThatReachDistanceOrAngleByOdometry) {
  ASSERT_GT(frames().size(), 20U);
  EXPECT_EQ(frames().front().stamp, scanStamps().front());
  for (std::size_t i = 0; i + 1 < frames().size(); ++i) {
    const auto& frame = frames()[i];
    EXPECT_TRUE(isFar(odometry_->between(frame.stamp, frames()[i + 1].stamp)->begin_from_end)) << "key frame " << i;
    for (const auto& dependent : frame.dependents) {
      EXPECT_FALSE(isFar(odometry_->between(frame.stamp, dependent.stamp)->begin_from_end)) << "after key frame " << i;
    }
  }
}

TEST_F(Engine, EveryScanIsAKeyFrameOrDependsOnTheOneBeforeIt) {
  std::vector<base::Stamp> stamps;
  for (const auto& frame : frames()) {
    stamps.push_back(frame.stamp);
    for (const auto& dependent : frame.dependents) {
      stamps.push_back(dependent.stamp);
      const auto motion = odometry_->between(frame.stamp, dependent.stamp);
      ASSERT_TRUE(motion);
      EXPECT_LT((dependent.keyframe_from_base - motion->begin_from_end).translation().norm(), 1e-9);
    }
  }
  EXPECT_EQ(stamps, scanStamps());
  const auto trajectory = map::denseTrajectory(engine_->view().map);
  EXPECT_EQ(trajectory.size(), scanStamps().size());
}

TEST_F(Engine, KeyFramesHoldTheRawAndTheDerivedObservationsOfTheirStamp) {
  for (const auto& frame : frames()) {
    ASSERT_EQ(frame.observations.size(), 2U);
    EXPECT_EQ(frame.observations[0]->sensorLabel, "laser");
    EXPECT_EQ(frame.observations[1]->sensorLabel, "laser.points");
    for (const auto& observation : frame.observations) EXPECT_EQ(observation->timestamp, frame.stamp);
  }
}

TEST_F(Engine, EachStretchOfOdometryIsCountedExactlyOnce) {
  const auto view = engine_->view();
  geometry::Se2 product;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::size_t next = 0;
  for (const auto& [id, record] : view.graph.factors()) {
    if (record.tags.owner != "odometry") continue;
    ASSERT_LT(next + 1, frames().size());
    EXPECT_EQ(record.variables, (std::vector{frames()[next].pose, frames()[next + 1].pose}));
    const auto& step = dynamic_cast<const graph::BetweenSe2&>(*record.factor).measured();
    covariance = geometry::composeCovariance(covariance, step, record.noise.covariance());
    product = product * step;
    ++next;
  }
  EXPECT_EQ(next + 1, frames().size()) << "one link from each key frame to the next";
  const auto whole = odometry_->between(frames().front().stamp, frames().back().stamp);
  ASSERT_TRUE(whole);
  const auto expected = geometry::project(geometry::fromMrpt(whole->begin_from_end));
  EXPECT_LT(minus(product, expected).norm(), 1e-9);
  const Eigen::Matrix3d expected_covariance = geometry::planarPart(whole->covariance);
  EXPECT_LT((covariance - expected_covariance).norm(), 1e-9 * expected_covariance.norm());
}

TEST_F(Engine, TheFirstPoseIsHeldAtTheOriginAndNoOther) {
  const auto view = engine_->view();
  for (const auto& frame : frames()) {
    EXPECT_EQ(view.graph.variable(frame.pose).fixed, frame.id == frames().front().id);
  }
  EXPECT_EQ(frames().front().map_from_base, mrpt::poses::CPose3D());
}

TEST_F(Engine, CountsEverythingItWasGiven) {
  const auto& counts = engine_->view().counts;
  EXPECT_EQ(counts.observations, observations_.size());
  EXPECT_EQ(counts.not_triggered + frames().size(), scanStamps().size());
  EXPECT_EQ(counts.unwanted + counts.no_stamp + counts.repeated_stamp + counts.too_late + counts.unusable +
                counts.unconnected,
            0U);
  EXPECT_EQ(counts.solves, engine_->view().solves.size());
}

TEST(EngineOptions, WithoutAPosePluginThereIsNoEngine) {
  try {
    makeEngine(kLaserIni, {"mapper.pose_plugins="});
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
  }
  EXPECT_NO_THROW(makeEngine(kLaserIni, {"mapper.measurement_plugins="})) << "the pose sources make the key frames";
}

TEST(EngineSensors, ScansOfOneStampShareOneKeyFrameAndOthersHaveTheirOwn) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  options.laps = 0.3;
  options.lasers.resize(3);
  options.lasers[1].label = "same time";
  options.lasers[1].base_from_sensor = mrpt::poses::CPose3D(-0.2, 0, 0.3, geometry::kPi, 0, 0);
  options.lasers[2].label = "later";
  options.lasers[2].phase += 0.031;
  const auto engine = makeEngine(kLaserIni, {"trigger.every_observation=true"});
  testing::run(*engine, SimulatedLog(options).observations());
  const auto& frames = engine->view().map.key_frames;
  std::set<base::Stamp> stamps;
  std::size_t both = 0, alone = 0;
  for (const auto& frame : frames) {
    EXPECT_TRUE(stamps.insert(frame.stamp).second);
    if (frame.observations.size() == 4) {
      ++both;
      EXPECT_EQ(frame.observations[0]->sensorLabel, "laser");
      EXPECT_EQ(frame.observations[1]->sensorLabel, "same time");
    } else {
      ++alone;
      ASSERT_EQ(frame.observations.size(), 2U);
      EXPECT_EQ(frame.observations[0]->sensorLabel, "later");
    }
  }
  EXPECT_GT(both, 30U);
  EXPECT_NEAR(static_cast<double>(both), static_cast<double>(alone), 1);
}

// A log that was perceived before already has the derived observations.
TEST(EngineSensors, WhatALogBringsPerceivedIsNotPerceivedTwice) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  options.laps = 0.3;
  const SimulatedLog log(options);
  const auto raw = makeEngine(kLaserIni);
  testing::run(*raw, log.observations());

  const auto config = base::Config::fromText(kLaserIni, "test.ini");
  const auto extractors = makePlugins({{}, {"laser_points"}, {}, {}}, config, {}).extractors;
  std::vector<CObservation::Ptr> perceived;
  for (const auto& observation : log.observations()) {
    perceived.push_back(observation);
    if (!extractors.front().plugin->wants(*observation)) continue;
    for (const auto& derived : extractors.front().plugin->extract(*observation)) perceived.push_back(derived);
  }
  const auto again = makeEngine(kLaserIni);
  testing::run(*again, perceived);
  EXPECT_EQ(testing::bitsOf(again->view()), testing::bitsOf(raw->view()));
}

// An extractor of laser points that counts its calls.
class Counting : public perception::Extractor {
 public:
  Counting(std::unique_ptr<perception::Extractor> inner, std::atomic<int>& count)
      : inner_(std::move(inner)), count_(count) {}
  bool wants(const CObservation& raw) const override { return inner_->wants(raw); }
  std::vector<CObservation::Ptr> extract(const CObservation& raw) const override {
    ++count_;
    return inner_->extract(raw);
  }
  std::vector<perception::DerivedName> namesOf(const CObservation& raw) const override { return inner_->namesOf(raw); }

 private:
  std::unique_ptr<perception::Extractor> inner_;
  std::atomic<int>& count_;
};

TEST(EngineSensors, AnExtractorDoesNotWorkOnWhatALogBringsPerceived) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  options.laps = 0.3;
  const SimulatedLog log(options);
  mapper::loadFeatures();
  const auto config = base::Config::fromText(kLaserIni, "test.ini");
  const auto settings = EngineSettings::read(config);
  const auto& names = settings.engine;
  std::vector<CObservation::Ptr> perceived;
  const auto extractor = std::move(makePlugins({{}, {"laser_points"}, {}, {}}, config, {}).extractors.front().plugin);
  for (const auto& observation : log.observations()) {
    if (extractor->wants(*observation))
      for (const auto& derived : extractor->extract(*observation)) perceived.push_back(derived);
    perceived.push_back(observation);
  }
  std::string bits;
  for (const int threads : {1, 2, 4}) {
    auto plugins = makePlugins({names.pose_plugins, {"laser_points"}, names.measurement_plugins, {}}, config, {});
    std::atomic<int> count{0};
    plugins.extractors.front().plugin = std::make_unique<Counting>(std::move(plugins.extractors.front().plugin), count);
    mapper::Engine engine(settings, "test", SensorPoses({}, config), std::move(plugins), threads);
    testing::run(engine, perceived);
    EXPECT_EQ(count, 0) << threads;
    EXPECT_GT(engine.view().map.key_frames.size(), 3U);
    if (threads == 1) bits = testing::bitsOf(engine.view());
    EXPECT_EQ(testing::bitsOf(engine.view()), bits) << threads;
  }
}

}  // namespace
}  // namespace omnimapper::mapper::engine_test
