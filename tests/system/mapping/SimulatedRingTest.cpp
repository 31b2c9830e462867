// Two laps of the simulated ring, mapped by omnimapper-graphslam from each of MRPT's two formats: every output is
// compared with the truth.
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::FloorPlan;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;
using Format = SimulatedLog::Format;

struct MappedRing {
  ScratchFolder scratch;
  SimulatedLog log;
  std::string folder;
  Ended ended;

  static SimulatedLogOptions options() {
    SimulatedLogOptions options;
    options.laps = 2;
    return options;
  }
  explicit MappedRing(Format format) : log(options()), folder(scratch / "map") {
    log.writeRawlog(scratch / "ring.rawlog", format);
    ended = map({scratch / "ring.rawlog"}, folder);
  }
};

class SimulatedRing : public ::testing::TestWithParam<Format> {
 protected:
  // The run of each format, which all tests share.
  static const MappedRing& ring() {
    static const MappedRing observations(Format::observations), frames(Format::actions_and_frames);
    return GetParam() == Format::observations ? observations : frames;
  }
  static std::string file(const std::string& name) { return ring().folder + "/" + name; }
};

/// Distance of a point from the nearest wall [m].
double distanceFromWalls(const FloorPlan& plan, const Eigen::Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& wall : plan.walls) {
    const Eigen::Vector2d along = wall.to - wall.from;
    const double part = std::clamp((p - wall.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - wall.from - part * along).norm());
  }
  return nearest;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

TEST_P(SimulatedRing, EndsWellAndLeavesEveryOutputAndNothingElse) {
  EXPECT_TRUE(endedWith(ExitCode::ok, ring().ended));
  EXPECT_EQ(filesIn(ring().folder), allOutputs());
  EXPECT_NE(ring().ended.out.find("key frames"), std::string::npos);
  EXPECT_EQ(ring().ended.err, "") << "no warning is expected";
}

TEST_P(SimulatedRing, TheTrajectoryHasOneLinePerScanAndLiesOnTheTruth) {
  const auto trajectory = loadTrajectory(ring().folder);
  EXPECT_EQ(stampsOf(trajectory), scanStamps(ring().log));
  const double error = errorAgainst(ring().log, trajectory);
  RecordProperty("ate_m", std::to_string(error));
  EXPECT_LT(error, 0.1);
}

TEST_P(SimulatedRing, LoopsAreClosedAndNoneIsWrong) {
  const auto closures = loopClosures(loadMap(ring().folder));
  EXPECT_GT(closures.size(), 20U);
  for (const auto& closure : closures) {
    const auto truth =
        omnimapper::geometry::fromMrpt(ring().log.truthAt(closure.here) - ring().log.truthAt(closure.place));
    const auto error = omnimapper::geometry::minus(closure.place_from_here, truth);
    EXPECT_LT(error.head<2>().norm(), 0.25);
    EXPECT_LT(std::abs(error[2]), 3 * omnimapper::geometry::kPi / 180);
  }
}

TEST_P(SimulatedRing, TheMapFileHoldsTheTrajectoryTheScansAndTheGraph) {
  const auto loaded = loadMap(ring().folder);
  const auto written = loadTrajectory(ring().folder);
  const auto trajectory = map_file::denseTrajectory(loaded.map);
  ASSERT_EQ(trajectory.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(trajectory[i].stamp, written[i].stamp);
    const auto pose = omnimapper::geometry::fromMrpt(trajectory[i].map_from_base);
    EXPECT_LT(minus(pose, written[i].world_from_body).norm(), 1e-6);
  }
  for (const auto& frame : loaded.map.key_frames) {
    EXPECT_EQ(frame.observations.size(), 2U) << "the scan and its points";
    const auto pose = omnimapper::graph::se2FromValue(loaded.graph.value(frame.pose).data());
    EXPECT_NEAR(pose.x, frame.map_from_base.x(), 1e-12);
    EXPECT_NEAR(pose.yaw, frame.map_from_base.yaw(), 1e-12);
  }
  EXPECT_EQ(loaded.graph.variables().size(), loaded.map.key_frames.size());
}

TEST_P(SimulatedRing, TheG2oFileIsTheSameGraph) {
  const auto loaded = loadMap(ring().folder);
  const auto g2o = omnimapper::graph::readG2o(file("graph.g2o"));
  EXPECT_EQ(g2o.graph.variables().size(), loaded.graph.variables().size());
  std::size_t acting = 0;
  for (const auto& [id, record] : loaded.graph.factors()) acting += record.weight > 0;
  EXPECT_EQ(g2o.graph.factors().size(), acting) << "refused closures must not be in it";
  EXPECT_NEAR(g2o.graph.chi2(), loaded.graph.chi2(), 1e-6 * loaded.graph.chi2());
}

// Grid, points and scene are in the frame of the truth, because the robot starts at its origin.
TEST_P(SimulatedRing, TheGridIsFreeWhereTheRobotWentAndItsWallsAreTheWalls) {
  const std::string yaml = readFile(file("grid.yaml")), pgm = readFile(file("grid.pgm"));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(yaml, found, std::regex(R"(resolution: (\S+)\norigin: \[(\S+), (\S+), 0.0\])")))
      << yaml;
  const double resolution = std::stod(found[1]), min_x = std::stod(found[2]), min_y = std::stod(found[3]);
  EXPECT_NE(yaml.find("image: grid.pgm\n"), std::string::npos);
  std::istringstream head(pgm.substr(0, 60));
  std::string magic;
  int columns = 0, rows = 0, most = 0;
  head >> magic >> columns >> rows >> most;
  ASSERT_EQ(magic + " " + std::to_string(most), "P5 255");
  const std::size_t start = static_cast<std::size_t>(head.tellg()) + 1;
  ASSERT_EQ(pgm.size(), start + static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto level = [&](int column, int row) {  // row 0 is the lowest y; the file's first row is the highest
    return static_cast<unsigned char>(pgm[start + static_cast<std::size_t>((rows - 1 - row) * columns + column)]);
  };
  std::map<int, int> under_robot;  // level, count
  for (const auto& pose : loadTrajectory(ring().folder)) {
    const auto p = ring().log.truthAt(pose.stamp);
    ++under_robot[level(static_cast<int>((p.x() - min_x) / resolution),
                        static_cast<int>((p.y() - min_y) / resolution))];
  }
  EXPECT_EQ(under_robot[0], 0) << "the robot was inside walls";
  EXPECT_LT(under_robot[205], 0.03 * under_robot[254])
      << "cells between the few beams along a corridor may stay unknown";
  std::vector<double> distances;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (level(column, row) != 0) continue;
      distances.push_back(distanceFromWalls(ring().log.plan(),
                                            {min_x + (column + 0.5) * resolution, min_y + (row + 0.5) * resolution}));
    }
  }
  ASSERT_GT(distances.size(), 1000U);
  EXPECT_LT(median(distances), 0.05);
  EXPECT_LT(*std::max_element(distances.begin(), distances.end()), 0.5);
}

TEST_P(SimulatedRing, ThePointsLieOnTheWalls) {
  const std::string ply = readFile(file("points.ply"));
  std::smatch found;
  const std::string header = ply.substr(0, ply.find("end_header\n") + 11);
  ASSERT_TRUE(std::regex_search(header, found, std::regex(R"(element vertex (\d+)\n)"))) << header;
  const std::size_t count = std::stoul(found[1]);
  constexpr std::size_t kBytes = 3 * sizeof(float) + 3;  // x y z, then red green blue
  ASSERT_EQ(ply.size(), header.size() + count * kBytes);
  ASSERT_GT(count, 1000U);
  std::vector<double> distances;
  for (std::size_t i = 0; i < count; ++i) {
    float xyz[3];
    std::memcpy(xyz, ply.data() + header.size() + i * kBytes, sizeof xyz);
    distances.push_back(distanceFromWalls(ring().log.plan(), {xyz[0], xyz[1]}));
    EXPECT_NEAR(xyz[2], 0.3, 0.01) << "the height of the laser";
  }
  EXPECT_LT(median(distances), 0.05);
}

TEST_P(SimulatedRing, TheSceneOpensAndShowsThePlace) {
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(file("scene.3Dscene")));
  const auto box = scene.getBoundingBox();
  EXPECT_GT(box.max.x - box.min.x, 23) << "as wide as the floor plan";
  EXPECT_LT(box.max.x - box.min.x, 40);
  EXPECT_GT(scene.getViewport()->size(), 3U);
}

TEST_P(SimulatedRing, PicturesOpenAndTheReportNeedsNothingElse) {
  for (const char* name : {"grid.png", "map.png"}) {
    mrpt::img::CImage image;
    ASSERT_TRUE(image.loadFromFile(file(name))) << name;
    EXPECT_GT(image.getWidth(), 100U) << name;
  }
  const std::string report = readFile(file("report.html"));
  for (const char* part : {"</html>", "<svg", "data:image/png;base64,", "loop closure", "scan_odometry"}) {
    EXPECT_NE(report.find(part), std::string::npos) << part;
  }
  const std::regex outside(R"re((src|href)\s*=\s*"(?!data:|#)[^"]*"|@import|url\((?!['"]?(data:|#)))re");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(report, found, outside)) << found.str();
}

TEST_P(SimulatedRing, TheSummaryAgreesWithTheMap) {
  const auto loaded = loadMap(ring().folder);
  const auto summary = loadSummary(ring().folder);
  EXPECT_EQ(summary["key_frames"], loaded.map.key_frames.size());
  EXPECT_EQ(summary["graph"]["factors"], loaded.graph.factors().size());
  EXPECT_EQ(summary["closures"]["accepted"], loopClosures(loaded).size());
  EXPECT_NEAR(summary["travel_m"], 2 * ring().log.lapLength(), 0.02 * ring().log.lapLength());
  EXPECT_EQ(summary["warnings"].size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Formats, SimulatedRing, ::testing::Values(Format::observations, Format::actions_and_frames),
                         [](const auto& format) {
                           return format.param == Format::observations ? "Observations" : "ActionsAndFrames";
                         });

}  // namespace
