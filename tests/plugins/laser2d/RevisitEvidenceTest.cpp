#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <cmath>

#include "laser2d/RevisitEvidence.h"

namespace omnimapper::plugins::revisit_evidence_test {
namespace {

using mapper::Evidence;
using Says = Evidence::Says;

// Drives 30 m along a line, jumps back, and drives it again with the same heading; one key frame each metre.
testing::HandMadeRun thereAgain() {
  testing::HandMadeRun run;
  for (int i = 0; i <= 30; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  for (int i = 0; i <= 30; ++i) run.addFrame({1.0 * i, 0.5, 0, 0, 0, 0});
  return run;
}

void close(testing::HandMadeRun& run, std::size_t from, std::size_t to, double weight = 1) {
  graph::FactorRecord record{{run.map.key_frames[from].pose, run.map.key_frames[to].pose},
                             std::make_shared<graph::BetweenSe2>(geometry::Se2{}),
                             graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(1, 1, 1))};
  record.weight = weight;
  record.tags.owner = "loops";
  run.graph.addFactor(std::move(record));
}

TEST(RevisitEvidence, WithoutARevisitTheEvidenceIsTooLittle) {
  testing::HandMadeRun run;
  for (int i = 0; i <= 30; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  const auto evidence = revisits(run.view(), "loops", {}, 8);
  EXPECT_EQ(evidence[0].says, Says::too_little);
  EXPECT_EQ(evidence[1].says, Says::good);
  EXPECT_TRUE(revisits(testing::HandMadeRun().view(), "loops", {}, 8)[0].says == Says::too_little) << "an empty map";
}

TEST(RevisitEvidence, NothingWasDrivenBetweenTwoSessions) {
  testing::HandMadeRun run;
  for (const std::uint16_t session : {0, 1}) {
    run.graph.setSession(session);
    for (int i = 0; i <= 4; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  }
  EXPECT_DOUBLE_EQ(revisits(run.view(), "loops", {}, 8)[0].value, 4);
}

TEST(RevisitEvidence, ALongRevisitWithoutAClosureIsAgainstTheMap) {
  const auto evidence = revisits(thereAgain().view(), "loops", {}, 8);
  EXPECT_EQ(evidence[0].says, Says::good);
  EXPECT_NEAR(evidence[0].value, 60, 1.5) << "30 m driven again, and 30 m of the jump back";
  EXPECT_EQ(evidence[1].says, Says::against_it);
  EXPECT_NE(evidence[1].reason.find("scans show something else"), std::string::npos);
}

// Two walls along the path, as a laser in the base sees them, with pillars every 4 m unless `bare`. All is shifted by
// `off` [m] to the side in the second pass.
testing::HandMadeRun thereAgainBetweenWalls(double off, bool bare = false) {
  auto run = thereAgain();
  for (std::uint32_t i = 0; i < run.map.key_frames.size(); ++i) {
    auto& frame = run.map.key_frames.edit({0, i});
    const double base_x = frame.map_from_base.x(), base_y = frame.map_from_base.y() + (i > 30 ? off : 0);
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (int k = -100; k <= 100; ++k) {
      const double x = base_x + 0.05 * k;
      const bool is_pillar = !bare && std::fmod(x + 400, 4) < 0.8;
      for (const double y : {-1.5, is_pillar ? 0.9 : 1.5})
        points->insertPoint(static_cast<float>(0.05 * k), static_cast<float>(y - base_y), 0);
    }
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->sensorLabel = "laser_points";
    cloud->pointcloud = points;
    frame.observations.push_back(cloud);
  }
  return run;
}

TEST(RevisitEvidence, ARevisitOnWhichTheScansFitIsNotAgainstTheMap) {
  const auto fits = revisits(thereAgainBetweenWalls(0).view(), "loops", {"laser_points"}, 8);
  EXPECT_EQ(fits[0].says, Says::good);
  EXPECT_EQ(fits[1].says, Says::good);
  EXPECT_EQ(fits[1].value, 0);
  EXPECT_NE(fits[0].reason.find("on 60.0 m that were driven again the scans fit"), std::string::npos) << fits[0].reason;
  const auto doubled = revisits(thereAgainBetweenWalls(0.5).view(), "loops", {"laser_points"}, 8);
  EXPECT_EQ(doubled[1].says, Says::against_it);
}

TEST(RevisitEvidence, ScansAlongBareWallsShowNothing) {
  const auto bare = revisits(thereAgainBetweenWalls(0, true).view(), "loops", {"laser_points"}, 8);
  EXPECT_EQ(bare[0].says, Says::too_little);
  EXPECT_NE(bare[0].reason.find("only along bare walls"), std::string::npos) << bare[0].reason;
  EXPECT_EQ(bare[1].says, Says::good) << "nor do they contradict the map";
  EXPECT_EQ(bare[2].says, Says::too_little);
}

// Drives 100 m along a line, then again from `from` [m] on, where every fifth key frame closes a loop.
Evidence spannedFrom(std::size_t from, bool closures) {
  testing::HandMadeRun run;
  for (int i = 0; i <= 100; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  for (std::size_t i = from; i <= 100; ++i) run.addFrame({static_cast<double>(i), 0.5, 0, 0, 0, 0});
  for (std::size_t i = from; closures && i <= 100; i += 5) close(run, i, i - from + 101);
  return revisits(run.view(), "loops", {}, 8).at(2);
}

TEST(RevisitEvidence, TooLittleTravelBetweenTwoVisitsIsReported) {
  const auto none = spannedFrom(95, false);
  EXPECT_EQ(none.value, 0) << "without a closure or fitting scans";
  EXPECT_EQ(none.says, Says::too_little);
  EXPECT_NE(none.reason.find("only 0 m of the 110 m"), std::string::npos) << none.reason;
  // The travel from 93 m on, the jump back, and the second pass: 7 + 5 + 5 m of 110.
  const auto end = spannedFrom(95, true), all = spannedFrom(10, true);
  EXPECT_NEAR(end.value, 100.0 * 17 / 110, 2);
  EXPECT_EQ(end.says, Says::too_little);
  EXPECT_NE(end.reason.find("m of the 110 m driven lie between two visits"), std::string::npos) << end.reason;
  EXPECT_NEAR(all.value, 100.0 * 272 / 280, 2);
  EXPECT_EQ(all.says, Says::good);
}

// Closures count whatever run they are of: a session that continues a map has those of earlier sessions only in the
// graph.
TEST(RevisitEvidence, AClosureOfTheGraphConfirmsFifteenMetresAroundIt) {
  auto run = thereAgain();
  close(run, 45, 14);
  const auto evidence = revisits(run.view(), "loops", {}, 8);
  EXPECT_EQ(evidence[1].reason.find("for 29 m"), std::string::npos);
  EXPECT_LT(evidence[1].value, revisits(thereAgain().view(), "loops", {}, 8)[1].value - 28);
}

TEST(RevisitEvidence, ARefusedClosureOrOneOfAnotherPluginConfirmsNothing) {
  auto run = thereAgain();
  const double unconfirmed = revisits(run.view(), "loops", {}, 8)[1].value;
  close(run, 45, 14, 0);
  EXPECT_EQ(revisits(run.view(), "loops", {}, 8)[1].value, unconfirmed);
  close(run, 45, 14);
  EXPECT_EQ(revisits(run.view(), "others", {}, 8)[1].value, unconfirmed);
}

}  // namespace
}  // namespace omnimapper::plugins::revisit_evidence_test
