// Runs ini/laser_walls.ini and ini/rgbd_planes.ini as their first lines say, on real logs and on simulated twins.
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/eval/ViewAgreement.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>

#include "../MapFolder.h"
#include "TrueWalls.h"

namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::sourceFile;

mrpt::poses::CPose3D worldFromMap(const std::string& place) {
  return omnimapper::geometry::toMrpt(
      omnimapper::eval::readTum(sourceFile(place + "/truth.tum")).front().world_from_body);
}

class WallsAndPlanes : public ::testing::Test {
 protected:
  /// Maps a log with an INI.
  void mapIt(const std::string& ini, const std::string& log, const Texts& more = {}) {
    Texts words{"-i", sourceFile("ini/" + ini), "-r", log, "-o", folder_};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_TRUE(endedWith(ExitCode::ok, graphslam(words)));
    plan_ = json::parse(readFile(folder_ + "/floorplan.geojson"))["features"];
  }
  std::string import(const Texts& words, const std::string& name) {
    Texts all{omnimapper::testing::ownProgram("omnimapper-import")};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.begin() + 3, scratch_ / name);
    EXPECT_TRUE(endedWith(ExitCode::ok, omnimapper::testing::runProgram(all)));
    return scratch_ / name;
  }
  /// Features of the floor plan with this label and at least so many measurements.
  std::vector<json> featuresOf(const std::string& label, int measurements) const {
    std::vector<json> found;
    for (const auto& feature : plan_) {
      const auto& properties = feature["properties"];
      if (properties.value("label", "") == label && properties["measurements"] >= measurements)
        found.push_back(feature);
    }
    return found;
  }
  std::size_t relationsThatAct() const {
    std::size_t count = 0;
    const auto loaded = loadMap(folder_);
    for (const auto& [id, record] : loaded.graph.factors())
      count += record.tags.owner == "relations" && record.weight > 0;
    return count;
  }

  /// How the map agrees with the depth images of a log that also has their poses, which are in the frame of the map.
  omnimapper::eval::ViewAgreement viewsOf(const std::string& log) const {
    omnimapper::eval::Trajectory poses;
    omnimapper::source::RawlogSource source(log);
    while (const auto observation = source.next()) {
      if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get()))
        poses.push_back({pose->timestamp, omnimapper::geometry::fromMrpt(pose->pose.mean)});
    }
    omnimapper::base::Progress silent;
    const auto read = omnimapper::eval::readViews(log, poses, {}, silent, [] { return false; });
    return omnimapper::eval::judgeByViews(omnimapper::surfaces::readSurfaces(folder_ + "/surfaces.json"), read.views);
  }

  /// Expects that the trajectory is within `metres` and 1 deg of every pose that the log gives for one of its stamps.
  void expectGivenPosesHold(const std::string& log, double metres) const {
    const auto trajectory = loadTrajectory(folder_);
    omnimapper::source::RawlogSource source(log);
    std::size_t given = 0;
    double farthest = 0, most_turned = 0;  // [m] [deg]
    while (const auto observation = source.next()) {
      const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get());
      if (!pose) continue;
      const auto at = omnimapper::eval::nearestPose(trajectory, pose->timestamp, std::chrono::milliseconds(1));
      if (!at) continue;
      ++given;
      const auto off = omnimapper::geometry::minus(
          trajectory[*at].world_from_body, omnimapper::geometry::fromMrpt(pose->pose.mean + (-pose->sensorPose)));
      farthest = std::max(farthest, off.head<3>().norm());
      most_turned = std::max(most_turned, off.tail<3>().norm() / M_PI * 180);
    }
    EXPECT_GT(given, 0.9 * static_cast<double>(trajectory.size()));
    EXPECT_LT(farthest, metres);
    EXPECT_LT(most_turned, 1);
  }

  ScratchFolder scratch_;
  std::string folder_ = scratch_ / "map";
  json plan_;
};

// The simulated twin of the test with Intel.
TEST_F(WallsAndPlanes, OfABoxAreItsFourWallsAtRightAngles) {
  mapIt("laser_walls.ini", sourceFile("rawlogs/box/box.rawlog"));
  const auto walls = featuresOf("wall", 10);
  EXPECT_EQ(walls.size(), 4U);
  const auto world_from_map = worldFromMap("rawlogs/box");
  const auto truth = trueWalls("rawlogs/box");
  for (const auto& wall : walls)
    EXPECT_LT(endsFromWalls(endsOf(wall["geometry"]), world_from_map, truth), 0.05) << wall["id"];
  EXPECT_GE(relationsThatAct(), 3U);
}

// Scan matching alone is 0.070 m from the reference (doc/results/planes.md).
TEST_F(WallsAndPlanes, OfIntelAreWallsAndBringItNearerToTheReference) {
  const auto log = sharedData("laser2d/intel.clf.bz2"), reference = sharedData("laser2d/intel.reference.tum");
  OMNIMAPPER_NEEDS(log);
  mapIt("laser_walls.ini", import({"carmen", *log}, "intel.rawlog"));
  EXPECT_GT(featuresOf("wall", 10).size(), 60U);
  EXPECT_GT(relationsThatAct(), 100U);
  omnimapper::eval::PairingOptions pairing;
  pairing.alignment = omnimapper::eval::Alignment::yaw;
  const auto error = omnimapper::eval::absoluteTrajectoryError(loadTrajectory(folder_),
                                                               omnimapper::eval::readTrajectory(*reference), pairing);
  EXPECT_LT(error.translation.rmse, 0.07);
}

TEST_F(WallsAndPlanes, OfACabinetAreItsTopItsSidesAndTheFloor) {
  const auto images = sharedData("rgbd/tum_fr3_cabinet58");
  OMNIMAPPER_NEEDS(images);
  const auto log = import({"tum", *images, "--poses"}, "cabinet.rawlog");
  mapIt("rgbd_planes.ini", log);
  expectGivenPosesHold(log, 0.01);
  EXPECT_EQ(featuresOf("floor", 20).size(), 1U);
  const auto faces = featuresOf("cabinet", 10);
  EXPECT_EQ(faces.size(), 5U);
  const auto is_top = [](const json& face) { return face["geometry"]["type"] == "Polygon"; };
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), is_top), 1);
  const auto agreement = viewsOf(log);
  EXPECT_TRUE(agreement.split.empty()) << agreement.split.size();
  EXPECT_LE(agreement.doubles.size(), 1U) << "two surfaces that are 5 m away";
  EXPECT_GT(agreement.area_twice.covered, 0.9 * agreement.area_twice.seen);
  EXPECT_LT(agreement.distance.median, 0.01);
}

TEST_F(WallsAndPlanes, OfACameraThatTurnsQuicklyHoldItsGivenPoses) {
  const auto images = sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(images);
  const auto log = import({"tum", *images, "--poses"}, "rpy.rawlog");
  ASSERT_TRUE(endedWith(ExitCode::ok, graphslam({"-i", sourceFile("ini/rgbd_planes.ini"), "-r", log, "-o", folder_,
                                                 "--set", "mapper.output_plugins=trajectory"})));
  expectGivenPosesHold(log, 0.02);
}

TEST_F(WallsAndPlanes, WithoutPosesNothingIsMapped) {
  const std::string log = scratch_ / "frames.rawlog";
  omnimapper::source::writeRawlog(log, [&](omnimapper::source::RawlogWriter& writer) {
    omnimapper::source::RawlogSource source(sourceFile("rawlogs/home_30s/home_30s.rawlog"));
    while (const auto observation = source.next()) {
      if (IS_CLASS(*observation, mrpt::obs::CObservation3DRangeScan)) writer.add(*observation);
    }
  });
  const auto ended = graphslam({"-i", sourceFile("ini/rgbd_planes.ini"), "-r", log, "-o", folder_});
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, ended));
  EXPECT_NE(ended.err.find("given_motion, poses"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(folder_ + "/map.omnimap"));
}

// Writes a log of the camera of the simulated home with its true poses, which are known every 50 ms: interpolated at
// the stamps of the images if `exact`, else those of the nearest known stamps, up to 20 ms away.
void writeCamera(const std::string& log, bool exact) {
  const std::string place = "rawlogs/home_30s";
  const auto truth = omnimapper::eval::readTum(sourceFile(place + "/truth.tum"));
  omnimapper::source::writeRawlog(log, [&](omnimapper::source::RawlogWriter& writer) {
    omnimapper::source::RawlogSource source(sourceFile(place + "/home_30s.rawlog"));
    while (const auto observation = source.next()) {
      if (!IS_CLASS(*observation, mrpt::obs::CObservation3DRangeScan)) continue;
      auto at = omnimapper::eval::interpolatedPose(truth, observation->timestamp, std::chrono::milliseconds(60));
      const auto nearest = omnimapper::eval::nearestPose(truth, observation->timestamp, std::chrono::milliseconds(20));
      if (!exact) at = nearest ? std::make_optional(truth[*nearest].world_from_body) : std::nullopt;
      if (!at) continue;
      mrpt::obs::CObservationRobotPose pose;
      pose.timestamp = observation->timestamp;
      pose.sensorLabel = "poses";
      pose.pose.mean = omnimapper::geometry::toMrpt(*at);
      writer.add(pose);
      writer.add(*observation);
    }
  });
}

// The simulated twins of the tests with the cabinet.
TEST_F(WallsAndPlanes, OfASimulatedCameraHoldItsGivenPoses) {
  const std::string log = scratch_ / "given.rawlog";
  writeCamera(log, true);
  mapIt("rgbd_planes.ini", log);
  expectGivenPosesHold(log, 0.01);
  const auto agreement = viewsOf(log);
  EXPECT_LE(agreement.split.size(), 1U);
  EXPECT_GT(agreement.area_twice.covered, 0.8 * agreement.area_twice.seen);
  EXPECT_LT(agreement.distance.median, 0.01);
}

// The sigmas of the poses account for stamps that are up to 20 ms off.
TEST_F(WallsAndPlanes, OfACameraOnGivenPosesAreWhereTheyAre) {
  const std::string place = "rawlogs/home_30s", log = scratch_ / "given.rawlog";
  writeCamera(log, false);
  mapIt("rgbd_planes.ini", log, {"--set", "poses.position_sigma_m=0.01", "--set", "poses.angle_sigma_deg=0.5"});
  const auto walls = trueWalls(place);
  std::size_t long_ones = 0;
  for (const auto& wall : featuresOf("wall", 5)) {
    const auto ends = endsOf(wall["geometry"]);
    if (std::hypot(ends[1][0].get<double>() - ends[0][0].get<double>(),
                   ends[1][1].get<double>() - ends[0][1].get<double>()) < 1.2)
      continue;  // may be furniture, whose planes are not in the truth
    ++long_ones;
    EXPECT_LT(endsFromWalls(ends, {}, walls), 0.08) << wall["id"];
  }
  EXPECT_GE(long_ones, 3U);
  EXPECT_GT(featuresOf("floor", 5).size(), 0U);
  EXPECT_GT(featuresOf("seat", 2).size() + featuresOf("cabinet", 2).size(), 0U);
}

}  // namespace
