#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/plugins/LaserPointsPlugin.h>
#include <omnimapper/plugins/ScanMatchingPlugin.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>

namespace omnimapper::plugins {
namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

// Clouds of scans of the ring, with the true pose of each.
struct Sight {
  mrpt::obs::CObservation::Ptr cloud;
  CPose2D map_from_base;
};

std::vector<Sight> sights(double laps) {
  testing::SimulatedLogOptions options;
  options.laps = laps;
  const testing::SimulatedLog log(options);
  const LaserPointsPlugin extractor{perception::LaserPointsOptions{}};
  std::vector<Sight> all;
  for (const auto& observation : log.observations()) {
    if (!extractor.wants(*observation)) continue;
    all.push_back({extractor.extract(*observation).front(), log.truthAt(observation->timestamp)});
  }
  return all;
}

ScanMatchingPlugin makePlugin(const ScanMatchingOptions& options = {}) {
  mapper::PluginContext context;
  context.section = "scan_matching";
  return ScanMatchingPlugin(options, {}, context);
}

// As the engine does it: prepared, then measured.
mapper::Batch measured(ScanMatchingPlugin& plugin, const map::KeyFrame& frame, const mrpt::obs::CObservation& cloud,
                       const testing::HandMadeRun& run) {
  const auto prepared = plugin.prepare(cloud);
  return plugin.measure(frame, {cloud, prepared.get()}, run.view());
}

double numberOf(const mapper::Decision& decision, const std::string& name) {
  for (const auto& [key, value] : decision.numbers) {
    if (key == name) return value;
  }
  ADD_FAILURE() << name << " is not told";
  return 0;
}

TEST(ScanMatchingPlugin, FindsTheTrueMotionFromAWrongPrediction) {
  const auto all = sights(1);
  for (const std::size_t i : {60UL, 150UL, 260UL, 380UL, 500UL}) {
    const auto& a = all.at(i);
    const auto& b = all.at(i + 7);  // half a metre on
    for (const CPose2D& wrong : {CPose2D(0, 0, 0), CPose2D(0.15, -0.1, 0), CPose2D(-0.1, 0.1, 8 * kDegree),
                                 CPose2D(0.05, 0.15, -8 * kDegree)}) {
      auto plugin = makePlugin();
      testing::HandMadeRun run;
      measured(plugin, run.addFrame(CPose3D(a.map_from_base)), *a.cloud, run);
      const auto batch = measured(plugin, run.addFrame(CPose3D(b.map_from_base + wrong)), *b.cloud, run);
      ASSERT_EQ(batch.addedFactors().size(), 1U) << batch.decisions().front().reason;
      const auto& factor = batch.addedFactors().front();
      EXPECT_EQ(factor.variables, (std::vector{run.map.key_frames[0].pose, run.map.key_frames[1].pose}));
      EXPECT_FALSE(factor.tags.hypothesis);
      const auto truth = geometry::fromMrpt(b.map_from_base - a.map_from_base);
      const auto error = minus(dynamic_cast<const graph::BetweenSe2&>(*factor.factor).measured(), truth);
      EXPECT_LT(error.head<2>().norm(), 0.03) << "scan " << i << ", prediction off by " << wrong;
      EXPECT_LT(std::abs(error.z()), 0.5 * kDegree) << "scan " << i << ", prediction off by " << wrong;
    }
  }
}

TEST(ScanMatchingPlugin, ScansOfTwoPlacesAreRefusedForTooLittleOverlap) {
  const auto all = sights(1);
  auto plugin = makePlugin();
  testing::HandMadeRun run;
  const CPose3D start(all[10].map_from_base);
  measured(plugin, run.addFrame(start), *all[10].cloud, run);
  const auto batch = measured(plugin, run.addFrame(start), *all[200].cloud, run);
  EXPECT_TRUE(batch.addedFactors().empty());
  ASSERT_EQ(batch.decisions().size(), 1U);
  const auto& decision = batch.decisions().front();
  EXPECT_FALSE(decision.accepted);
  EXPECT_EQ(decision.reason, "too little overlap");
  EXPECT_EQ(decision.kind, "sequential match");
  EXPECT_EQ(decision.plugin, "scan_matching");
  EXPECT_EQ(decision.from, run.map.key_frames[1].id);
  EXPECT_EQ(decision.to, run.map.key_frames[0].id);
  EXPECT_LT(numberOf(decision, "overlap"), ScanMatchingOptions().min_overlap);
}

TEST(ScanMatchingPlugin, MatchesBeyondTheGateAreRefusedWithTheReason) {
  const auto all = sights(0.5);
  const auto& a = all.at(100);
  const auto& b = all.at(107);
  const auto reason = [&](const ScanMatchingOptions& options, const CPose2D& wrong) {
    auto plugin = makePlugin(options);
    testing::HandMadeRun run;
    measured(plugin, run.addFrame(CPose3D(a.map_from_base)), *a.cloud, run);
    return measured(plugin, run.addFrame(CPose3D(b.map_from_base + wrong)), *b.cloud, run).decisions().front().reason;
  };
  ScanMatchingOptions strict;
  strict.max_correction = 0.05;
  EXPECT_EQ(reason(strict, CPose2D(0.15, 0, 0)), "too far from the prediction");
  strict = {};
  strict.max_turn_correction = 2 * kDegree;
  EXPECT_EQ(reason(strict, CPose2D(0, 0, 6 * kDegree)), "turned too far from the prediction");
  EXPECT_EQ(reason({}, CPose2D(0.15, 0, 6 * kDegree)), "matched");
}

TEST(ScanMatchingPlugin, WantsCloudsOfScansOrThoseOfItsLabels) {
  const auto cloud = sights(0.05).front().cloud;
  EXPECT_TRUE(makePlugin().wants(*cloud));
  EXPECT_FALSE(makePlugin().wants(mrpt::obs::CObservation2DRangeScan()));
  ScanMatchingOptions options;
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

TEST(ScanMatchingPlugin, NoLoopIsTriedOnAFirstStraightAndBend) {
  testing::SimulatedLogOptions options;
  options.laps = 0.35;
  const auto engine = testing::makeEngine(testing::kLaserIni);
  testing::run(*engine, testing::SimulatedLog(options).observations());
  EXPECT_GT(engine->view().map.key_frames.size(), 35U);
  EXPECT_TRUE(loopClosures(engine->view()).empty());
}

TEST(ScanMatchingPlugin, OnTheSecondLapClosuresLieOnTheTruth) {
  testing::SimulatedLogOptions options;
  options.laps = 1.4;
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
    EXPECT_LT((from - to).norm(), ScanMatchingOptions().loop_radius) << "a false closure";
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

TEST(ScanMatchingPlugin, LoopsAreClosedOnlyWhereTheUserSaysSo) {
  testing::SimulatedLogOptions options;
  options.laps = 1.1;
  const auto engine = testing::makeEngine(testing::kLaserIni, {"scan_matching.close_loops=false"});
  testing::run(*engine, testing::SimulatedLog(options).observations());
  EXPECT_TRUE(loopClosures(engine->view()).empty());
}

}  // namespace
}  // namespace omnimapper::plugins
