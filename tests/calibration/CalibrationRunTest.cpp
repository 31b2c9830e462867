#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/calibration/DepthCamera.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "RenderedRoom.h"

namespace omnimapper::calibration::calibration_run_test {
namespace {

using matching::posed;
using mrpt::obs::CObservation3DRangeScan;

/// The calibration that a log declares, and the true one, which is that of the rendered room.
struct Log {
  double picture_focal = 260, picture_cx = 159.5, picture_cy = 119.5, depth_focal = 260;
  geometry::Se3 depth_from_picture;     ///< the true pose
  geometry::Se3 declared_from_picture;  ///< the pose that the log declares
  double true_picture_focal = 260, true_scale = 1;
  bool has_picture = true, has_depth = true, moves = true, has_poses = false;
  int images = 60;
};

geometry::Se3 handAt(double t) {
  return posed(0.35 * std::sin(t), 0.2 * std::sin(1.4 * t), 0.3 * std::sin(0.8 * t), 0.3 * std::sin(1.1 * t),
               0.5 * std::sin(0.7 * t), 0.4 * std::sin(0.5 * t));
}

void setCamera(mrpt::img::TCamera& camera, double focal, double cx, double cy) {
  camera.setIntrinsicParamsFromValues(focal, focal, cx, cy);
  camera.ncols = 320;
  camera.nrows = 240;
}

CObservation3DRangeScan imageOf(const Log& log, int number) {
  matching::RenderedRoom room;
  room.tiles = 5;
  const auto world_from_picture = handAt(log.moves ? 0.12 * number : 0);
  auto picture_room = room;
  picture_room.camera.fx = picture_room.camera.fy = log.true_picture_focal;
  const auto picture = picture_room.render(world_from_picture);
  const auto depths = room.render(world_from_picture * inverse(log.depth_from_picture));
  CObservation3DRangeScan scan;
  scan.timestamp = base::stampFromUnix(1.6e9) + base::durationFromSeconds(0.1 * number);
  scan.sensorLabel = "camera";
  scan.range_is_depth = true;
  scan.rangeUnits = 0.0002F;
  setCamera(scan.cameraParams, log.depth_focal, 159.5, 119.5);
  setCamera(scan.cameraParamsIntensity, log.picture_focal, log.picture_cx, log.picture_cy);
  scan.relativePoseIntensityWRTDepth = geometry::toMrpt(geometry::sensorFromOptical() * log.declared_from_picture);
  scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, 0);
  scan.hasRangeImage = log.has_depth;
  if (log.has_depth) {
    scan.rangeImage_setSize(240, 320);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x)
        scan.rangeImage(y, x) = static_cast<std::uint16_t>(std::lround(
            static_cast<double>(depths.depth[static_cast<std::size_t>(y * 320 + x)]) / 0.0002 / log.true_scale));
  }
  scan.hasIntensityImage = log.has_picture;
  if (log.has_picture) {
    scan.intensityImage = mrpt::img::CImage(320, 240, mrpt::img::CH_GRAY);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x)
        *scan.intensityImage.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y)) =
            picture.grey[static_cast<std::size_t>(y * 320 + x)];
  }
  return scan;
}

class CalibrationRunTest : public ::testing::Test {
 protected:
  void write(const Log& log) {
    source::writeRawlog(request_.logs.front(), [&](source::RawlogWriter& rawlog) {
      for (int i = 0; i < log.images; ++i) {
        const auto scan = imageOf(log, i);
        if (log.has_poses) {
          mrpt::obs::CObservationRobotPose pose;
          pose.timestamp = scan.timestamp;
          pose.sensorLabel = "poses";
          const auto world_from_depth = handAt(0.12 * i) * inverse(log.depth_from_picture);
          pose.pose.mean = geometry::toMrpt(world_from_depth * inverse(geometry::sensorFromOptical()));
          rawlog.add(pose);
        }
        rawlog.add(scan);
      }
    });
  }
  CalibrationResult run() {
    base::Progress progress;
    return runCalibration(request_, progress, [] { return false; });
  }
  std::string refusal() {
    try {
      run();
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::nothing_to_map);
      EXPECT_FALSE(std::filesystem::exists(request_.output + "/calibration.ini"));
      return error.what();
    }
    ADD_FAILURE() << "it was not refused";
    return "";
  }
  // The log's camera after the written calibration is applied to it.
  DepthCamera corrected(const Log& log) {
    auto scan = imageOf(log, 0);
    const auto config = base::Config::fromFile(request_.output + "/calibration.ini");
    const auto calibration = camera::CameraCalibration::read(config);
    EXPECT_TRUE(calibration.isOf("camera"));
    calibration.applyTo(scan);
    auto camera = cameraOf(scan).value();
    camera.depth_scale = static_cast<double>(scan.rangeUnits) / 0.0002;
    return camera;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(request_.output + "/" + name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }

  testing::ScratchFolder folder_;
  CalibrationRequest request_{{folder_ / "camera.rawlog"}, "", folder_ / "out", ""};
};

TEST_F(CalibrationRunTest, FindsACameraThatTheLogHasWrong) {
  Log log;
  log.picture_focal = log.depth_focal = 265;  // 2 %
  write(log);
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::ok);
  ASSERT_TRUE(result.is_better) << result.text;
  const auto camera = corrected(log);
  EXPECT_TRUE(camera.is_registered) << "the picture stays that of the depths' view";
  EXPECT_NEAR(camera.picture[0], 260, 1.3) << result.text;
  EXPECT_NEAR(camera.picture[1], 260, 1.3);
  EXPECT_NEAR(camera.picture[2], 159.5, 1.5);
  EXPECT_NEAR(camera.picture[3], 119.5, 1.5);
  EXPECT_NEAR(camera.depth_scale, 1, 1e-6) << "nothing measures metres";
  EXPECT_NE(result.text.find("nothing in the log measures metres"), std::string::npos);
  for (const std::string name : {"report.txt", "summary.json", "residuals.svg"})
    EXPECT_FALSE(read(name).empty()) << name;

  const auto once = read("calibration.ini") + read("summary.json") + read("residuals.svg");
  run();
  EXPECT_EQ(read("calibration.ini") + read("summary.json") + read("residuals.svg"), once) << "bytes of two runs";
}

TEST_F(CalibrationRunTest, FindsWhereThePictureIsTakenAndTheScaleByGivenPoses) {
  Log log;
  log.true_picture_focal = 270;
  log.picture_focal = 274;
  log.depth_from_picture = posed(0.03, 0, 0, 0, 0, 0);
  log.declared_from_picture = posed(0.035, 0.005, 0, 0.5 * base::option_text::kRadiansPerDegree, 0, 0);
  log.true_scale = 1.03;
  log.has_poses = true;
  write(log);
  const auto result = run();
  ASSERT_TRUE(result.is_better) << result.text;
  const auto camera = corrected(log);
  EXPECT_NEAR(camera.picture[0], 270, 1.5) << result.text;
  EXPECT_NEAR(camera.depth_scale, 1.03, 0.006);
  const geometry::Vector6d off = minus(camera.depth_from_picture, log.depth_from_picture);
  EXPECT_LT(off.tail<3>().norm(), 0.35 * base::option_text::kRadiansPerDegree);
}

TEST_F(CalibrationRunTest, ValuesOfTheGivenIniAreWrittenAgain) {
  Log log;
  write(log);
  request_.ini = folder_ / "before.ini";
  std::ofstream(request_.ini) << "[calibration]\ndepth_scale = 1.02\npicture_fx_px = 265\npicture_fy_px = 265\n"
                                 "depth_fx_px = 265\ndepth_fy_px = 265\n"
                                 "depth_distortion_per_m = 0.0001, 0, -0.0002\n";
  const auto result = run();
  const auto camera = corrected(log);
  EXPECT_NEAR(camera.picture[0], 260, 1.3) << result.text;
  EXPECT_NEAR(camera.depth_scale, 1.02, 1e-6) << "nothing measures metres";
  EXPECT_NE(read("calibration.ini").find("depth_distortion_per_m = 0.0001, 0, -0.0002\n"), std::string::npos);
}

TEST_F(CalibrationRunTest, ACameraAtRestIsRefusedWithARemedy) {
  Log log;
  log.moves = false;
  log.images = 15;
  write(log);
  const auto message = refusal();
  EXPECT_NE(message.find("moved too little"), std::string::npos) << message;
  EXPECT_NE(message.find("record half a minute"), std::string::npos) << message;
  EXPECT_NE(message.find("camera.rawlog"), std::string::npos) << message;
}

TEST_F(CalibrationRunTest, ALogThatIsTooShortIsRefused) {
  Log log;
  log.images = 4;
  write(log);
  EXPECT_NE(refusal().find("of 10 that are needed"), std::string::npos);
}

TEST_F(CalibrationRunTest, ALogWithoutPicturesIsRefused) {
  Log log;
  log.has_picture = false;
  log.images = 3;
  write(log);
  EXPECT_NE(refusal().find("no pictures"), std::string::npos);
}

TEST_F(CalibrationRunTest, ALogWithoutDepthsIsRefused) {
  Log log;
  log.has_depth = false;
  log.images = 3;
  write(log);
  EXPECT_NE(refusal().find("no depth images"), std::string::npos);
}

TEST_F(CalibrationRunTest, ALogWithoutACameraOrWithAnotherLabelIsRefused) {
  source::writeRawlog(request_.logs.front(), [](source::RawlogWriter& rawlog) {
    mrpt::obs::CObservation2DRangeScan scan;
    scan.timestamp = base::stampFromUnix(1.6e9);
    scan.sensorLabel = "laser";
    rawlog.add(scan);
  });
  EXPECT_NE(refusal().find("no observation of a camera with depths"), std::string::npos);
  request_.label = "front";
  EXPECT_NE(refusal().find("'front'"), std::string::npos);
}

TEST_F(CalibrationRunTest, ImagesOfAnotherSizeAndMissingOnesAreLeftOutAndCounted) {
  source::writeRawlog(request_.logs.front(), [&](source::RawlogWriter& rawlog) {
    for (int i = 0; i < 60; ++i) {
      auto scan = imageOf({}, i);
      if (i == 20) scan.intensityImage = mrpt::img::CImage(160, 120, mrpt::img::CH_GRAY);
      if (i == 40) scan.intensityImage.setExternalStorage("not_there.png");
      rawlog.add(scan);
    }
  });
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::missing_images);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.front().find("1 image of the camera left out, the first because its picture has 160 x 120"),
            std::string::npos)
      << result.warnings.front();
}

TEST_F(CalibrationRunTest, TheFolderOfAMapIsNotTaken) {
  std::filesystem::create_directories(request_.output);
  std::ofstream(request_.output + "/map.omnimap") << "a map";
  try {
    run();
    ADD_FAILURE() << "it was taken";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unwritable_output);
  }
  EXPECT_TRUE(std::filesystem::exists(request_.output + "/map.omnimap"));
}

TEST_F(CalibrationRunTest, TheProgramSaysWhatIsMissing) {
  const auto program = testing::ownProgram("omnimapper-calibrate");
  const auto none = testing::runProgram({program});
  EXPECT_EQ(none.code, 2) << testing::toString(none);
  const auto help = testing::runProgram({program, "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("omnimapper-calibrate rgbd -r"), std::string::npos) << help.out;
  const auto missing = testing::runProgram({program, "rgbd", "-r", folder_ / "none.rawlog", "-o", folder_ / "out"});
  EXPECT_EQ(missing.code, 8) << testing::toString(missing);
  EXPECT_NE(missing.err.find("none.rawlog"), std::string::npos) << missing.err;
}

// Starts from nominal intrinsics without a lens and finds the focal length that the benchmark calibrated with a board.
TEST_F(CalibrationRunTest, OfARealKinectItFindsTheLens) {
  const auto folder = testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  OMNIMAPPER_NEEDS_FORMAT("rgbd_folder");
  request_.views = 60;
  const auto ini = base::Config::fromText("[source_rgbd_folder]\nintrinsics = openni\n", "");
  const auto images = source::openLogs({*folder}, source::readSourceOptions(ini));
  source::writeRawlog(
      request_.logs.front(),
      [&](source::RawlogWriter& rawlog) {
        while (const auto image = images->next()) rawlog.add(*image);
      },
      source::ColourImages::jpeg);
  const auto result = run();
  ASSERT_TRUE(result.is_better) << result.text;
  const auto config = base::Config::fromFile(request_.output + "/calibration.ini");
  const auto calibration = config.section("calibration").read<camera::CameraCalibrationOptions>();
  EXPECT_NEAR(calibration.picture_fx.value(), 517.3, 8) << result.text;
  EXPECT_NEAR(calibration.picture_k1.value(), 0.2624, 0.12);
}

}  // namespace
}  // namespace omnimapper::calibration::calibration_run_test
