// ini/rgbd_robot.ini and ini/rgbd_handheld.ini on a real log and on simulated ones.
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ownProgram;
using omnimapper::testing::runProgram;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::sourceFile;

class Cameras : public ::testing::Test {
 protected:
  void mapIt(const std::string& ini, const std::string& log, const Texts& more = {}) {
    Texts words{"-i", sourceFile("ini/" + ini), "-r", log, "-o", folder_};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_TRUE(endedWith(ExitCode::ok, graphslam(words)));
  }
  omnimapper::eval::AbsoluteTrajectoryError errorFrom(const std::string& truth) const {
    omnimapper::eval::PairingOptions pairing;
    pairing.alignment = omnimapper::eval::Alignment::se3;
    return omnimapper::eval::absoluteTrajectoryError(loadTrajectory(folder_), omnimapper::eval::readTrajectory(truth),
                                                     pairing);
  }

  const ScratchFolder scratch_;
  const std::string folder_ = scratch_ / "map";
};

TEST_F(Cameras, InTheHandTurningQuicklyIsMappedByItsImagesAlone) {
  const auto images = sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(images);
  const std::string log = scratch_ / "rpy.rawlog";
  ASSERT_TRUE(endedWith(ExitCode::ok, runProgram({ownProgram("omnimapper-import"), "tum", *images, log})));
  mapIt("rgbd_handheld.ini", log);
  const auto error = errorFrom(*images + "/groundtruth.txt");
  EXPECT_GT(error.translation_errors.size(), 400U);
  EXPECT_LT(error.translation.rmse, 0.015);
}

// The simulated twin of the test above.
TEST_F(Cameras, InTheHandInASimulatedHomeIsMappedByItsImagesAlone) {
  const std::string place = scratch_ / "home";
  ASSERT_TRUE(endedWith(
      ExitCode::ok, runProgram({ownProgram("omnimapper-simulate"), "-i", sourceFile("rawlogs/home_handheld.ini"), "-o",
                                place, "--set", "simulation.duration_s=8"})));
  mapIt("rgbd_handheld.ini", place + "/home_handheld.rawlog");
  EXPECT_LT(errorFrom(place + "/truth.tum").translation.rmse, 0.02);
  const auto level = loadSummary(folder_).at("level");
  EXPECT_EQ(level.at("from"), "planes") << level;
  EXPECT_NEAR(level.at("up").at(0).get<double>(), std::sin(0.13), 0.03) << "the first image looks down: " << level;
  EXPECT_NE(readFile(folder_ + "/surfaces.json").find("\"floor\""), std::string::npos);
}

TEST_F(Cameras, OnARobotAreMappedWithItsWheels) {
  const std::string place = sourceFile("rawlogs/home_30s");
  mapIt("rgbd_robot.ini", place + "/home_30s.rawlog");
  EXPECT_LT(errorFrom(place + "/truth.tum").translation.rmse, 0.02);
  EXPECT_FALSE(readFile(folder_ + "/floorplan.geojson").empty());
}

// The z axis of the given poses points up. Errors of the camera's depths tilt desks and floors by some degrees, which
// the standard deviation accounts for.
TEST_F(Cameras, OnGivenPosesKnowWhichWayIsUpByWhatTheySee) {
  const auto images = sharedData("rgbd/tum_fr3_cabinet58");
  OMNIMAPPER_NEEDS(images);
  const std::string log = scratch_ / "cabinet.rawlog";
  ASSERT_TRUE(endedWith(ExitCode::ok, runProgram({ownProgram("omnimapper-import"), "tum", *images, log, "--poses"})));
  mapIt("rgbd_planes.ini", log);
  const auto level = loadSummary(folder_).at("level");
  EXPECT_EQ(level.at("from"), "planes") << level;
  EXPECT_GT(level.at("up").at(2).get<double>(), 0.9998) << "1 deg: " << level;
}

// The simulated twin of the test above: the first image of the hand-held camera is tilted by 6 deg.
TEST_F(Cameras, InASimulatedHandKnowWhichWayIsUpByAnAccelerometer) {
  const std::string place = scratch_ / "home";
  omnimapper::testing::ProgramOptions patient;
  patient.limit = 300;  // 200 images take 50 s of a free core
  const Texts simulate{ownProgram("omnimapper-simulate"),
                       "-i",
                       sourceFile("rawlogs/home_handheld.ini"),
                       "-o",
                       place,
                       "--set",
                       "simulation.duration_s=20",
                       "--set",
                       "simulation.sensors=kinect, imu",
                       "--set",
                       "imu.class=Imu",
                       "--set",
                       "imu.rate_hz=100"};
  ASSERT_TRUE(endedWith(ExitCode::ok, runProgram(simulate, patient)));
  mapIt("rgbd_handheld.ini", place + "/home_handheld.rawlog",
        {"--set", "perception.extractors=", "--set", "mapper.measurement_plugins=view_links"});
  const auto level = loadSummary(folder_).at("level");
  ASSERT_EQ(level.at("from"), "imu") << level;
  EXPECT_GT(level.at("up").at(2).get<double>(), 0.97) << level;
  EXPECT_LT(level.at("standard_deviation_deg").get<double>(), 2) << level;
}

}  // namespace
