#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/plugin/Verdict.h>
#include <omnimapper/testing/LogVariants.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>

#include "laser2d/LoopClosurePlugin.h"

namespace omnimapper::plugins::loop_closure_plugin_test {
namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;

LoopClosurePlugin makePlugin(const LoopClosureOptions& options = {}) {
  mapper::PluginContext context;
  context.section = "loop_closure";
  return LoopClosurePlugin(options, {}, context);
}

TEST(LoopClosurePlugin, WantsCloudsOfScansOrThoseOfItsLabels) {
  const auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = "laser.points";
  EXPECT_TRUE(makePlugin().wants(*cloud));
  EXPECT_FALSE(makePlugin().wants(mrpt::obs::CObservation2DRangeScan()));
  LoopClosureOptions options;
  options.labels = {"rear.points"};
  EXPECT_FALSE(makePlugin(options).wants(*cloud));
  cloud->sensorLabel = "rear.points";
  EXPECT_TRUE(makePlugin(options).wants(*cloud));
  cloud->sensorLabel = "velodyne";
  EXPECT_FALSE(makePlugin().wants(*cloud));
}

std::vector<mapper::Decision> loopClosures(const mapper::View& view) {
  std::vector<mapper::Decision> found;
  std::copy_if(view.decisions.begin(), view.decisions.end(), std::back_inserter(found),
               [](const auto& decision) { return decision.kind == "loop closure"; });
  return found;
}

TEST(LoopClosurePlugin, NoLoopIsTriedOnAFirstStraightAndCurve) {
  testing::SimulatedLogOptions options;
  options.laps = 0.35;
  const auto engine = testing::makeEngine(testing::kLaserIni);
  testing::run(*engine, testing::SimulatedLog(options).observations());
  EXPECT_GT(engine->view().map.key_frames.size(), 35U);
  EXPECT_TRUE(loopClosures(engine->view()).empty());
}

TEST(LoopClosurePlugin, OnTheSecondLapClosuresLieOnTheTruth) {
  testing::SimulatedLogOptions options;
  options.laps = 1.6;
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(testing::kLaserIni);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  std::size_t accepted = 0;
  for (const auto& decision : loopClosures(view)) {
    EXPECT_FALSE(decision.reason.empty());
    if (!decision.accepted) continue;
    ++accepted;
    const auto from = log.truthAt(decision.stamp);
    const auto to = log.truthAt(view.map.keyFrame(*decision.to).stamp);
    EXPECT_LT((from - to).norm(), LoopClosureOptions().radius) << "a false closure";
  }
  EXPECT_GT(accepted, 10U);
  std::size_t hypotheses = 0, wrong = 0;
  for (const auto& [id, record] : view.graph.factors()) {
    if (!record.tags.hypothesis || record.weight == 0) continue;
    ++hypotheses;
    EXPECT_EQ(record.loss.kind(), graph::Loss::Kind::cauchy);
    const auto stamp = [&](base::VariableId pose) {
      const auto& frames = view.map.key_frames;
      return std::find_if(frames.begin(), frames.end(), [&](const auto& f) { return f.pose == pose; })->stamp;
    };
    const auto truth =
        geometry::fromMrpt(log.truthAt(stamp(record.variables[1])) - log.truthAt(stamp(record.variables[0])));
    const auto error = minus(dynamic_cast<const graph::BetweenSe2&>(*record.factor).measured(), truth);
    if (error.head<2>().norm() < 0.1 && std::abs(error.z()) < 1.5 * kDegree) continue;
    ++wrong;
  }
  EXPECT_EQ(hypotheses, accepted);
  EXPECT_EQ(wrong, 0U) << "a wrong closure that acts";
}

// Only the wheels measure the motion. While the laser is silent for 5 s they turn by 40 deg too much, which only places
// seen before can reveal.
class UnseenSlip : public ::testing::Test {
 protected:
  UnseenSlip() {
    testing::SimulatedLogOptions options;
    options.laps = 2;
    options.travel_scale = 1;
    options.yaw_drift_per_m = 0;
    options.position_noise_per_root_m = options.yaw_noise_per_root_turn = 0.005;
    log_ = std::make_unique<testing::SimulatedLog>(options);
    slipping_ = testing::variantOf(log_->observations(), testing::LogVariant::unseen_slip);
  }
  std::unique_ptr<mapper::Engine> mapped(int threads) const {
    auto engine =
        testing::makeEngine(testing::kLaserIni,
                            {"mapper.pose_plugins=odometry, no_motion", "odometry.position_noise_per_root_m=0.02",
                             "odometry.yaw_noise_per_root_m_deg=0.3", "odometry.yaw_noise_per_root_turn=0.01"},
                            threads);
    testing::run(*engine, slipping_);
    return engine;
  }
  std::unique_ptr<testing::SimulatedLog> log_;
  std::vector<mrpt::obs::CObservation::Ptr> slipping_;
};

TEST_F(UnseenSlip, IsUndoneWhenTheRobotComesWhereItWasBefore) {
  const auto engine = mapped(1);
  const auto view = engine->view();
  const auto slips = std::count_if(view.decisions.begin(), view.decisions.end(),
                                   [](const auto& decision) { return decision.kind == kSlip && decision.accepted; });
  EXPECT_EQ(slips, 1);
  EXPECT_EQ(view.verdict.answer, mapper::Verdict::Answer::consistent) << sentenceOf(view.verdict);
  EXPECT_NE(sentenceOf(view.verdict).find("was undone"), std::string::npos) << sentenceOf(view.verdict);
  for (const auto& frame : view.map.key_frames)
    EXPECT_LT((mrpt::poses::CPose2D(frame.map_from_base) - log_->truthAt(frame.stamp)).norm(), 0.3)
        << toString(frame.id);
}

TEST_F(UnseenSlip, IsUndoneAlikeWithAnyNumberOfThreads) {
  EXPECT_EQ(testing::bitsOf(mapped(1)->view()), testing::bitsOf(mapped(4)->view()));
}

}  // namespace
}  // namespace omnimapper::plugins::loop_closure_plugin_test
