#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "laser2d/WallEvidence.h"

namespace omnimapper::plugins::wall_evidence_test {
namespace {

using Says = mapper::Evidence::Says;

// Adds a key frame at (x, y) that sees a wall at x = 5, from y = -2 to 2, as a laser in the base does.
void addFrame(testing::HandMadeRun& run, double x, double y) {
  run.addFrame({x, y, 0, 0, 0, 0});
  auto points = mrpt::maps::CSimplePointsMap::Create();
  for (int k = -40; k <= 40; ++k) points->insertPoint(static_cast<float>(5 - x), static_cast<float>(0.05 * k - y), 0);
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = "laser_points";
  cloud->pointcloud = points;
  run.map.key_frames.edit({0, static_cast<std::uint32_t>(run.map.key_frames.size() - 1)}).observations.push_back(cloud);
}

testing::HandMadeRun beforeTheWall() {
  testing::HandMadeRun run;
  for (int i = 0; i < 8; ++i) addFrame(run, 0.5 * i, 0.1 * i);
  return run;
}

TEST(WallEvidence, ATrackBesideWallsIsGood) {
  const auto evidence = throughWalls(beforeTheWall().map, {"laser_points"});
  ASSERT_EQ(evidence.size(), 2U);
  EXPECT_EQ(evidence[1].name, "track_through_walls");
  EXPECT_EQ(evidence[1].says, Says::good);
  EXPECT_EQ(evidence[1].value, 0);
}

TEST(WallEvidence, ATrackThatLeadsThroughAWallTwiceIsAgainstTheMap) {
  auto run = beforeTheWall();
  addFrame(run, 4.2, 0);
  run.addFrame({5.6, 0, 0, 0, 0, 0});
  const auto once = throughWalls(run.map, {"laser_points"});
  EXPECT_EQ(once.at(1).value, 1);
  EXPECT_EQ(once.at(1).says, Says::good) << "a door may have closed behind the robot";
  run.addFrame({4.2, 0.5, 0, 0, 0, 0});
  const auto twice = throughWalls(run.map, {"laser_points"});
  EXPECT_EQ(twice.at(1).value, 2);
  EXPECT_EQ(twice.at(1).says, Says::against_it);
  EXPECT_NE(twice.at(1).reason.find("leads through walls of the map 2 times, first 9 s after the start"),
            std::string::npos)
      << twice.at(1).reason;
}

TEST(WallEvidence, AcrossAGapTheWayIsNotKnown) {
  auto run = beforeTheWall();
  for (int i = 0; i < 4; ++i) run.addFrame({i % 2 == 0 ? 8.0 : 3.5, 0, 0, 0, 0, 0});
  EXPECT_EQ(throughWalls(run.map, {"laser_points"}).at(1).value, 0);
}

TEST(WallEvidence, WithoutScansThereIsTooLittle) {
  const auto evidence = throughWalls(testing::HandMadeRun().map, {"laser_points"});
  ASSERT_EQ(evidence.size(), 1U);
  EXPECT_EQ(evidence[0].says, Says::too_little);
}

}  // namespace
}  // namespace omnimapper::plugins::wall_evidence_test
