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
  void mapIt(const std::string& ini, const std::string& log) {
    ASSERT_TRUE(endedWith(ExitCode::ok, graphslam({"-i", sourceFile("ini/" + ini), "-r", log, "-o", folder_})));
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

// The twin.
TEST_F(Cameras, InTheHandInASimulatedHomeIsMappedByItsImagesAlone) {
  const std::string place = scratch_ / "home";
  ASSERT_TRUE(endedWith(
      ExitCode::ok, runProgram({ownProgram("omnimapper-simulate"), "-i", sourceFile("rawlogs/home_handheld.ini"), "-o",
                                place, "--set", "simulation.duration_s=8"})));
  mapIt("rgbd_handheld.ini", place + "/home_handheld.rawlog");
  EXPECT_LT(errorFrom(place + "/truth.tum").translation.rmse, 0.02);
}

TEST_F(Cameras, OnARobotAreMappedWithItsWheels) {
  const std::string place = sourceFile("rawlogs/home_30s");
  mapIt("rgbd_robot.ini", place + "/home_30s.rawlog");
  EXPECT_LT(errorFrom(place + "/truth.tum").translation.rmse, 0.02);
  EXPECT_FALSE(readFile(folder_ + "/floorplan.geojson").empty());
}

}  // namespace
