#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/testing/MapperRun.h>

#include <set>

#include "../plugin/GraphInvariants.h"
#include "Engine.h"
#include "SteadyMotion.h"

// Thesis 5.2.3.3: an observation that comes late gets its place in the trajectory, and nothing else changes. A robot
// moves at 1 m/s; a comment is an observation that becomes a key frame.
namespace omnimapper::mapper::splicing_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;
using testing::at;
using testing::Steady;

class Listener : public MeasurementPlugin {
 public:
  bool wants(const CObservation&) const override { return true; }
  Batch measure(const map::KeyFrame& frame, const Observed&, const View&) override {
    measured.push_back(frame.id);
    return {};
  }
  bool givesAbsolutePoses() const override { return absolute; }

  bool absolute = false;
  std::vector<base::KeyFrameId> measured;
};

class Splicing : public ::testing::Test {
 protected:
  Engine& start(double horizon = 30, bool absolute = false) {
    EngineSettings settings;
    settings.trigger.every_observation = true;
    settings.engine.window = 0;
    settings.engine.horizon = horizon;
    PluginSet set;
    set.pose.push_back({"steady", std::make_unique<Steady>()});
    auto listener = std::make_unique<Listener>();
    listener->absolute = absolute;
    listener_ = listener.get();
    set.measurement.push_back({"listener", std::move(listener)});
    engine_ = std::make_unique<Engine>(settings, "splicing", SensorPoses(), std::move(set), 1);
    return *engine_;
  }
  void add(double seconds, const std::string& label = "talker") {
    auto comment = CObservationComment::Create();
    comment->timestamp = at(seconds);
    comment->sensorLabel = label;
    engine_->add(comment);
  }
  // Seconds of the key frames in the order of the trajectory.
  std::vector<double> seconds() const {
    std::vector<double> all;
    for (const auto& frame : engine_->view().map.key_frames) all.push_back(base::secondsBetween(at(0), frame.stamp));
    return all;
  }

  std::unique_ptr<Engine> engine_;
  Listener* listener_ = nullptr;
};

TEST_F(Splicing, TheFactorAcrossTheStampIsReplacedByTwo) {
  auto& engine = start();
  for (const double second : {0, 1, 3, 4}) add(second);
  add(2.5);
  engine.finish();
  const auto view = engine.view();
  EXPECT_EQ(seconds(), (std::vector<double>{0, 1, 2.5, 3, 4}));
  testing::expectOneChain(view, {"steady"});
  EXPECT_EQ(listener_->measured.back(), view.map.key_frames[2].id);
  EXPECT_NEAR(view.map.key_frames[2].map_from_base.x(), 2.5, 1e-9);
  // The span from 1 s to 3 s had one factor of variance 0.02; it now has two, of 0.015 and 0.005.
  const auto variance = [&](std::size_t i) {
    for (const auto id : view.graph.factorsOf(view.map.key_frames[i].pose)) {
      const auto& record = view.graph.factor(id);
      if (record.variables.size() == 2 && record.variables[1] == view.map.key_frames[i].pose) {
        return record.noise.covariance()(0, 0);
      }
    }
    return 0.0;
  };
  EXPECT_NEAR(variance(2), 0.015, 1e-9);
  EXPECT_NEAR(variance(3), 0.005, 1e-9);
  EXPECT_EQ(view.counts.late, 1U);
  EXPECT_EQ(view.counts.spliced, 1U);
}

TEST_F(Splicing, BeforeTheFirstPoseThePriorMoves) {
  auto& engine = start();
  for (const double second : {5, 6, 7}) add(second);
  add(3);
  engine.finish();
  const auto view = engine.view();
  EXPECT_EQ(seconds(), (std::vector<double>{3, 5, 6, 7}));
  EXPECT_TRUE(view.graph.variable(view.map.key_frames[0].pose).fixed);
  EXPECT_FALSE(view.graph.variable(view.map.key_frames[1].pose).fixed);
  EXPECT_NEAR(view.map.key_frames[0].map_from_base.x(), -2, 1e-9) << "the map stays where it was";
  EXPECT_NEAR(view.map.key_frames[3].map_from_base.x(), 2, 1e-9);
  EXPECT_EQ(view.map.sessions.front().anchor, view.map.key_frames[0].pose);
  testing::expectOneChain(view, {"steady"});
}

TEST_F(Splicing, BeforeTheFirstPoseOfAMapThatMeasurementsPlaceThePriorIsStillOne) {
  auto& engine = start(30, true);
  for (const double second : {5, 6, 4, 3}) add(second);
  engine.finish();
  const auto view = engine.view();
  std::vector<base::VariableId> held;
  for (const auto& [id, record] : view.graph.factors()) {
    if (record.tags.owner == "engine") held.push_back(record.variables.front());
  }
  EXPECT_EQ(held, std::vector<base::VariableId>{view.map.key_frames[0].pose});
}

TEST_F(Splicing, AtTheStampOfAKeyFrameItBecomesOneOfItsObservations) {
  auto& engine = start();
  for (const double second : {0, 1, 2}) add(second);
  add(1, "slow");
  add(1, "slow");
  engine.finish();
  const auto view = engine.view();
  ASSERT_EQ(view.map.key_frames.size(), 3U);
  EXPECT_EQ(view.map.key_frames[1].observations.size(), 2U);
  EXPECT_EQ(view.counts.spliced, 0U);
  EXPECT_EQ(listener_->measured.size(), 4U);
  EXPECT_EQ(view.counts.repeated_stamp, 1U);
}

TEST_F(Splicing, BeyondTheHorizonItIsRefusedAndCounted) {
  auto& engine = start(5);
  for (int second = 0; second <= 20; ++second) add(second);
  add(3.5);
  engine.finish();
  EXPECT_EQ(engine.view().map.key_frames.size(), 21U);
  EXPECT_EQ(engine.view().counts.too_late, 1U);
}

TEST_F(Splicing, ManyLateOnesInAnyOrderGiveTheSameChain) {
  auto& engine = start();
  for (const double second : {0, 10}) add(second);
  for (const double second : {5.0, 2.5, 7.5, 1.0, 9.0, 6.0, 2.0, 3.0}) add(second);
  engine.finish();
  EXPECT_EQ(seconds(), (std::vector<double>{0, 1, 2, 2.5, 3, 5, 6, 7.5, 9, 10}));
  testing::expectOneChain(engine.view(), {"steady"});
  testing::expectNothingDangles(engine.view());
  EXPECT_NEAR(engine.view().graph.chi2(), 0, 1e-12);
}

// After an hour at rest the key frame before a late scan is older than the horizon. The odometry of that hour is still
// known, and no guess replaces it.
TEST(SplicingAfterARest, OdometryOfTheWholeStretchIsKept) {
  const std::string ini = R"(
[mapper]
pose_plugins        = odometry, no_motion
measurement_plugins = tracker
horizon_s = 60
[trigger]
period_s = 5000
[odometry]
class = OdometryPlugin
[no_motion]
class = NoMotionPlugin
[tracker]
class = RobotPosePlugin
reference_is_map = false
)";
  const auto engine = testing::makeEngine(ini);
  const auto odometry = [&](double seconds, double x) {
    auto reading = mrpt::obs::CObservationOdometry::Create();
    reading->timestamp = at(seconds);
    reading->sensorLabel = "odometry";
    reading->odometry = mrpt::poses::CPose2D(x, 0, 0);
    engine->add(reading);
  };
  const auto tracked = [&](double seconds, double x, const std::string& label) {
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->timestamp = at(seconds);
    pose->sensorLabel = label;
    pose->pose.mean = mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0);
    engine->add(pose);
  };
  // A key frame at 1 s, an hour of rest, then 1 m a second.
  for (int second = 0; second <= 3600; second += 10) {
    odometry(second, 0);
    if (second == 0) tracked(1, 0, "tracker");
  }
  for (int second = 3601; second <= 3640; ++second) {
    odometry(second, second - 3600);
    tracked(second, second - 3600, "tracker");
  }
  tracked(3615.5, 15.5, "late");
  tracked(3600.25, 0.25, "late");
  engine->finish();
  const auto view = engine->view();
  EXPECT_EQ(view.counts.late, 2U);
  EXPECT_GE(view.counts.spliced, 1U);
  testing::expectOneChain(view, {"odometry", "no_motion"});
  for (const auto& [id, record] : view.graph.factors()) EXPECT_NE(record.tags.owner, "no_motion");
}

}  // namespace
}  // namespace omnimapper::mapper::splicing_test
