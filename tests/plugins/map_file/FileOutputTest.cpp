#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <omnimapper/derived/SceneParts.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "map_file/MapOutput.h"
#include "run_files/GraphOutput.h"
#include "run_files/SummaryOutput.h"
#include "run_files/TrajectoryOutput.h"
#include "scene/PointsOutput.h"
#include "scene/SceneOutput.h"

namespace file_output_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(TrajectoryOutput, hasOneLineForEachObservationWithStampsToTheTick) {
  ScratchFolder folder;
  RunRecord run;
  map::KeyFrame first;
  first.stamp = at(0.1234567);
  first.map_from_base = CPose3D(1, -2, 0.5, -M_PI / 2, 0, 0);
  first.dependents.push_back({at(0.25), CPose3D(1, 0, 0, 0, 0, 0)});
  run.map.key_frames.insert(first);
  plugins::TrajectoryOutput({}, contextFor(folder.path())).finish(run.view());
  const auto lines = linesOf(contentOf(folder / "trajectory.tum"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "1000000000.1234567 1.000000000 -2.000000000 0.500000000 0.000000000 0.000000000 -0.707106781 0.707106781");
  EXPECT_EQ(lines[1],
            "1000000000.2500000 1.000000000 -3.000000000 0.500000000 0.000000000 0.000000000 -0.707106781 0.707106781");
}

TEST(TrajectoryOutput, dependentFramesAreLeftOutOnRequest) {
  ScratchFolder folder;
  plugins::TrajectoryOutput({}, contextFor(folder.path())).finish(boxRun().view());
  EXPECT_EQ(linesOf(contentOf(folder / "trajectory.tum")).size(), 4u);
  plugins::TrajectoryOptions options;
  options.key_frames_only = true;
  plugins::TrajectoryOutput(options, contextFor(folder.path())).finish(boxRun().view());
  EXPECT_EQ(linesOf(contentOf(folder / "trajectory.tum")).size(), 3u);
}

TEST(GraphOutput, readsBackAsTheSameGraph) {
  ScratchFolder folder;
  const RunRecord run = boxRun();
  plugins::GraphOutput({}, contextFor(folder.path())).finish(run.view());
  const auto content = graph::readG2o(folder / "graph.g2o");
  EXPECT_EQ(content.graph.variables().size(), 3u);
  EXPECT_EQ(content.graph.factors().size(), 3u);
  EXPECT_NEAR(content.graph.chi2(), run.graph.chi2(), 1e-9 * run.graph.chi2());
}

TEST(MapOutput, loadsBackAndIsTheSameFileEachTime) {
  ScratchFolder folder;
  const RunRecord run = boxRun();
  plugins::MapOutput({}, contextFor(folder.path())).finish(run.view());
  const std::string bytes = contentOf(folder / "map.omnimap");
  const auto file = map::MapFile::read(folder / "map.omnimap");
  ASSERT_NE(file.find("frames"), nullptr);
  ASSERT_NE(file.find("graph"), nullptr);
  RunRecord loaded;
  loaded.map = map::framesFromSection(*file.find("frames"));
  std::istringstream graph_bytes(file.find("graph")->bytes);
  loaded.graph = graph::readGraph(graph_bytes, graph::FactorRegistry::withBuiltIns());
  EXPECT_EQ(loaded.map.key_frames.size(), 3u);
  EXPECT_DOUBLE_EQ(loaded.graph.chi2(), run.graph.chi2());
  plugins::MapOutput({}, contextFor(folder.path())).finish(loaded.view());
  EXPECT_EQ(contentOf(folder / "map.omnimap"), bytes);
}

TEST(MapOutput, timesDoNotEnterIt) {
  ScratchFolder folder;
  RunRecord run = boxRun();
  plugins::MapOutput({}, contextFor(folder.path())).finish(run.view());
  const std::string bytes = contentOf(folder / "map.omnimap");
  run.times.add(mapper::Stage::solve, "", 123);
  run.times.addKeyFrame({0, 0, 77});
  plugins::MapOutput({}, contextFor(folder.path())).finish(run.view());
  EXPECT_EQ(contentOf(folder / "map.omnimap"), bytes);
}

struct PlyPoint {
  float x, y, z;
  unsigned char r, g, b;
};

std::vector<PlyPoint> readPly(const std::string& path) {
  const std::string content = contentOf(path);
  const std::string end = "end_header\n";
  const std::size_t start = content.find(end) + end.size();
  const std::string header = content.substr(0, start);
  EXPECT_EQ(header.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  const std::string element = "element vertex ";
  const std::size_t count = std::stoul(header.substr(header.find(element) + element.size()));
  EXPECT_EQ(content.size() - start, 15 * count) << "4 + 4 + 4 + 1 + 1 + 1 bytes of each point";
  std::vector<PlyPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = content.data() + start + 15 * i;
    std::memcpy(&points[i], at, 12);
    std::memcpy(&points[i].r, at + 12, 3);
  }
  return points;
}

TEST(PointsOutput, beamEndsLieOnTheWallsAtTheHeightOfTheSensor) {
  ScratchFolder folder;
  derived::PointsOptions options;
  options.voxel = 0;
  plugins::PointsOutput(options, contextFor(folder.path())).finish(boxRun().view());
  const auto points = readPly(folder / "points.ply");
  EXPECT_EQ(points.size(), 3u * 271u);
  for (const PlyPoint& p : points) {
    EXPECT_LT(distanceToWalls(p.x, p.y), 1e-5);
    EXPECT_NEAR(p.z, 0.3, 1e-6);
  }
  // A flat map is coloured by time, from blue to red.
  EXPECT_GT(points.front().b, points.front().r);
  EXPECT_GT(points.back().r, points.back().b);
}

TEST(PointsOutput, oneIsKeptOfEachVoxel) {
  ScratchFolder folder;
  derived::PointsOptions options;
  options.voxel = 0.25;
  plugins::PointsOutput(options, contextFor(folder.path())).finish(boxRun().view());
  const auto points = readPly(folder / "points.ply");
  EXPECT_LT(points.size(), 120u);  // 15.6 m of walls
  EXPECT_GT(points.size(), 50u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(std::floor(points[i].x / 0.25) == std::floor(points[k].x / 0.25) &&
                   std::floor(points[i].y / 0.25) == std::floor(points[k].y / 0.25));
    }
  }
}

TEST(PointsOutput, withoutPointsThereIsNoFile) {
  ScratchFolder folder;
  RunRecord run = boxRun();
  clearObservations(run);
  plugins::PointsOutput({}, contextFor(folder.path())).finish(run.view());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PointsOutput, cloudsGoBeforeScansAndAreColouredByHeight) {
  ScratchFolder folder;
  RunRecord run = boxRun();
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1, 0, 0);
  points->insertPoint(1, 0, 1.5);
  points->insertPoint(1, 0, 3);
  points->insertPoint(500, 0, 0);                                      // beyond max_range
  points->insertPoint(std::numeric_limits<float>::quiet_NaN(), 0, 0);  // no point at all
  cloud->pointcloud = points;
  cloud->sensorPose = CPose3D(0, 0, 1, M_PI / 2, 0, 0);
  map::KeyFrame& frame = run.map.key_frames.edit(run.map.key_frames[1].id);
  frame.map_from_base = CPose3D(10, 0, 0, 0, 0, 0);
  frame.observations.push_back(cloud);
  plugins::PointsOutput({}, contextFor(folder.path())).finish(run.view());
  const auto written = readPly(folder / "points.ply");
  ASSERT_EQ(written.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(written[i].x, 10, 1e-5);
    EXPECT_NEAR(written[i].y, 1, 1e-5);
    EXPECT_NEAR(written[i].z, 1 + 1.5 * static_cast<double>(i), 1e-5);
  }
  EXPECT_GT(written[0].b, written[0].r);
  EXPECT_GT(written[2].r, written[2].b);
}

TEST(PointsOutput, aMapWithoutPointsGivesNoFile) {
  ScratchFolder folder;
  plugins::PointsOutput({}, contextFor(folder.path())).finish(RunRecord().view());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(SceneOutput, sessionsHaveTwoColours) {
  const auto lines =
      derived::trajectoryLines({{at(0), {}, 0}, {at(1), {}, 0}, {at(2), {}, 1}, {at(3), {}, 2}, {at(4), {}, 2}});
  const auto of = [&](const char* name) {
    return std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(lines->getByName(name));
  };
  ASSERT_TRUE(of("newest session") && of("earlier sessions"));
  EXPECT_EQ(of("newest session")->size(), 1u);
  EXPECT_EQ(of("earlier sessions")->size(), 1u) << "no line leads from one session to another";
  EXPECT_EQ(of("newest session")->getColor_u8(), mrpt::img::TColor(37, 99, 235));
  EXPECT_NE(of("earlier sessions")->getColor_u8(), of("newest session")->getColor_u8());
}

TEST(SceneOutput, loadsBackWithTrajectoryPointsAndClosures) {
  ScratchFolder folder;
  plugins::SceneOptions options;
  options.refused_closures = true;
  plugins::SceneOutput(options, contextFor(folder.path())).finish(boxRun().view());
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder / "scene.3Dscene"));
  const auto linesNamed = [&](const char* name) {
    const auto lines = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName(name));
    return lines ? lines->size() : 0;
  };
  EXPECT_EQ(linesNamed("newest session"), 3u);
  EXPECT_EQ(linesNamed("earlier sessions"), 0u);
  EXPECT_EQ(linesNamed("closures"), 1u);
  EXPECT_EQ(linesNamed("refused closures"), 1u);
  const auto cloud = std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(scene.getByName("points"));
  ASSERT_TRUE(cloud);
  EXPECT_GT(cloud->size(), 100u);
  EXPECT_TRUE(scene.getByName("ground"));
}

TEST(SceneOutput, anEmptyMapIsAnEmptyScene) {
  ScratchFolder folder;
  plugins::SceneOutput({}, contextFor(folder.path())).finish(RunRecord().view());
  mrpt::opengl::COpenGLScene scene;
  EXPECT_TRUE(scene.loadFromFile(folder / "scene.3Dscene"));
}

TEST(SummaryOutput, holdsTheFiguresOfTheRun) {
  ScratchFolder folder;
  RunRecord run = boxRun();
  run.warnings = {"the log is \"cut\""};
  plugins::SummaryOutput({}, contextFor(folder.path())).finish(run.view());
  const auto summary = nlohmann::json::parse(contentOf(folder / "summary.json"));
  EXPECT_EQ(summary["title"], "box <world>");
  EXPECT_EQ(summary["key_frames"], 3);
  EXPECT_EQ(summary["trajectory_poses"], 4);
  EXPECT_EQ(summary["last_stamp"], "1000000002.0000000");
  EXPECT_NEAR(summary["travel_m"], std::hypot(1, 0.25) + std::hypot(0.5, 1), 1e-9);
  EXPECT_NEAR(summary["trajectory_extent_m"]["max"][1], 1.25, 1e-9);
  EXPECT_EQ(summary["closures"]["accepted"], 1);
  EXPECT_EQ(summary["closures"]["refused"], 0) << "that of the same key frames counts once";
  EXPECT_EQ(summary["counts"]["observations"], 12);
  EXPECT_EQ(summary["graph"]["factors_by_owner"]["odometry"], 2);
  EXPECT_EQ(summary["graph"]["factors_by_kind"]["prior_se2"], 1);
  EXPECT_NEAR(summary["graph"]["chi2"], run.graph.chi2(), 1e-9);
  EXPECT_EQ(summary["decisions"].size(), 4u);
  EXPECT_EQ(summary["solves"][0]["final_cost"], 20.0);
  EXPECT_EQ(summary["stage_times"]["solve"]["calls"], 1);
  EXPECT_EQ(summary["warnings"][0], "the log is \"cut\"");
}

}  // namespace
}  // namespace file_output_test
