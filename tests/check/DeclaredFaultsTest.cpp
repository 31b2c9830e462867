// What a log declares of its sensors is contradicted by what they measured.
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/DeclaredFaults.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>

#include "CheckedLog.h"

namespace omnimapper::check::declared_faults_test {
namespace {

using testing::DeclaredFault;
using testing::withFault;

Observations read(const std::string& path) {
  Observations all;
  const auto log = source::openLogs({path}, {});
  while (auto observation = log->next()) all.push_back(std::move(observation));
  return all;
}

/// Half a minute of the simulated home: a laser, wheels, and a camera that takes an image every two seconds.
const Observations& home() {
  static const auto log = read(testing::sourceFile("rawlogs/home_30s/home_30s.rawlog"));
  return log;
}

/// The findings, but for notes.
std::size_t warningsOf(const Checked& checked) {
  return static_cast<std::size_t>(std::count_if(checked.findings.begin(), checked.findings.end(),
                                                [](const Finding& one) { return one.weight != Weight::note; }));
}

TEST(DeclaredFaults, AGoodLogHasNone) {
  const Checked checked(home());
  EXPECT_EQ(warningsOf(checked), 0U) << checked.text();
  EXPECT_EQ(toIni(checked.settings), "");
  ASSERT_EQ(checked.facts.cameras.size(), 1U);
  const auto& camera = checked.facts.cameras.front();
  EXPECT_NEAR(camera.height->value, 1.1, 0.02);
  EXPECT_LT(camera.tilt, 0.01);
  ASSERT_TRUE(camera.scale);
  EXPECT_NEAR(camera.scale->value, 1, 0.01);
  EXPECT_NEAR(camera.focal->value, 1, 0.02);
}

TEST(DeclaredFaults, ThePoseOfTheCameraIsMeasuredAndProposed) {
  const Checked turned(withFault(home(), {DeclaredFault::camera_yaw, -10}));
  EXPECT_TRUE(turned.says("problem: 'kinect': is turned by ")) << turned.text();
  EXPECT_EQ(warningsOf(turned), 1U) << turned.text();
  const std::string yaw = turned.proposed("place_of_kinect", "pose_yaw_deg");  // left out if it is 0.0
  EXPECT_NEAR(yaw.empty() ? 0 : std::stod(yaw), 0, 0.5);
  EXPECT_NEAR(std::stod(turned.proposed("place_of_kinect", "pose_pitch_deg")), 10, 0.5);
  EXPECT_EQ(turned.proposed("place_of_kinect", "pose_z_m"), "1.10");

  for (const double roll : {8.0, 180.0}) {
    const Checked rolled(withFault(home(), {DeclaredFault::camera_roll, roll}));
    EXPECT_TRUE(rolled.says("problem: 'kinect': is ")) << rolled.text();
    EXPECT_TRUE(rolled.says("by the floor that it sees")) << rolled.text();
    const std::string proposed = rolled.proposed("place_of_kinect", "pose_roll_deg");
    EXPECT_NEAR(proposed.empty() ? 0 : std::stod(proposed), 0, 1) << roll;
  }
}

TEST(DeclaredFaults, ACameraAtAnotherHeightThanDeclaredIsNamedBesideALaser) {
  for (const double height : {0.8, 1.3}) {
    auto log = withFault(home(), {DeclaredFault::camera_yaw, 0});
    each<mrpt::obs::CObservation3DRangeScan>(log, [&](auto& scan) { scan.sensorPose.z(height); });
    const Checked checked(log);
    EXPECT_TRUE(checked.says("warning: 'kinect': its pose declares a height of ")) << checked.text();
    EXPECT_EQ(warningsOf(checked), 1U) << checked.text();
    EXPECT_NEAR(std::stod(checked.proposed("place_of_kinect", "pose_z_m")), 1.1, 0.021);
    EXPECT_NEAR(std::stod(checked.proposed("place_of_kinect", "pose_pitch_deg")), 10, 0.3);
  }
}

TEST(DeclaredFaults, TheUnitOfDepthsIsMeasuredAndProposed) {
  for (const double scale : {0.2, 1000.0}) {
    const Checked checked(withFault(home(), {DeclaredFault::depth_scale, scale}));
    EXPECT_TRUE(checked.says("problem: 'kinect': the true depths are")) << scale << "\n" << checked.text();
    EXPECT_EQ(warningsOf(checked), 1U) << checked.text();
    EXPECT_NEAR(std::stod(checked.proposed("calibration", "depth_scale")) * scale, 1, 0.02) << scale;
    EXPECT_EQ(checked.proposed("calibration", "label"), "kinect");
  }
}

TEST(DeclaredFaults, TheFocalLengthIsMeasuredAndProposed) {
  for (const double factor : {1.3}) {
    const Checked checked(withFault(home(), {DeclaredFault::focal_length, factor}));
    EXPECT_TRUE(checked.says("problem: 'kinect': the true focal length is")) << checked.text();
    EXPECT_NEAR(std::stod(checked.proposed("calibration", "depth_fx_px")), 525, 15) << factor;
  }
}

TEST(DeclaredFaults, MirroredImagesAndRangesForDepthsAreNamed) {
  const Checked mirrored(withFault(home(), {DeclaredFault::mirrored_images}));
  EXPECT_EQ(mirrored.proposed("calibration", "mirrored"), "true") << mirrored.text();
  EXPECT_EQ(warningsOf(mirrored), 1U) << mirrored.text();
  const Checked ranges(withFault(home(), {DeclaredFault::ranges_as_depths}));
  EXPECT_EQ(ranges.proposed("calibration", "depth_is_range"), "true") << ranges.text();
}

TEST(DeclaredFaults, TheClockOfTheCameraIsMeasuredAndProposed) {
  for (const double late : {-0.3}) {
    const Checked checked(withFault(home(), {DeclaredFault::camera_clock, late}));
    EXPECT_TRUE(checked.says("problem: 'kinect' and 'laser': their clocks differ")) << checked.text();
    EXPECT_NEAR(std::stod(checked.proposed("place_of_kinect", "clock_offset_s")), -late, 0.03) << checked.text();
  }
}

/// The log with depth images of every `step`-th pixel.
Observations smaller(const Observations& log, int step) {
  auto copies = withFault(log, {DeclaredFault::camera_yaw, 0});
  each<mrpt::obs::CObservation3DRangeScan>(copies, [&](auto& scan) {
    const auto pixels = scan.rangeImage;
    scan.rangeImage_setSize(static_cast<int>(pixels.rows()) / step, static_cast<int>(pixels.cols()) / step);
    for (int row = 0; row < scan.rangeImage.rows(); ++row) {
      for (int column = 0; column < scan.rangeImage.cols(); ++column)
        scan.rangeImage(row, column) = pixels(step * row, step * column);
    }
    scan.hasIntensityImage = false;
    scan.cameraParams.scaleToResolution(static_cast<unsigned>(scan.rangeImage.cols()),
                                        static_cast<unsigned>(scan.rangeImage.rows()));
  });
  return copies;
}

TEST(DeclaredFaults, SmallDepthImagesWorkOrAreSaidToGiveNothing) {
  const Checked small(smaller(home(), 4));
  ASSERT_EQ(small.facts.cameras.size(), 1U);
  const auto& camera = small.facts.cameras.front();
  EXPECT_EQ(camera.columns, 160U);
  if (camera.noise == 1) {
    EXPECT_GT(camera.planes, camera.images) << small.text();
  } else {
    EXPECT_TRUE(small.says("its images show surfaces only with")) << small.text();
    EXPECT_NE(small.proposed("planes", "noise_at_1m_m"), "") << small.text();
  }
  const Checked tiny(smaller(home(), 40));  // 16 x 12 pixels
  EXPECT_TRUE(tiny.says("its images give no surfaces: 0 planes in")) << tiny.text();
}

TEST(DeclaredFaults, ImagesOfAnotherSizeThanTheirCalibrationAreNamed) {
  auto log = withFault(home(), {DeclaredFault::camera_yaw, 0});
  each<mrpt::obs::CObservation3DRangeScan>(log, [](auto& scan) {
    scan.hasIntensityImage = true;
    scan.intensityImage = mrpt::img::CImage(320, 240, mrpt::img::CH_RGB);
    scan.cameraParamsIntensity = scan.cameraParams;  // of 640 x 480 px
  });
  const Checked half(log);
  EXPECT_TRUE(
      half.says("problem: 'kinect': its colour images have 320 x 240 px, but their calibration is that of "
                "images of 640 x 480 px; set picture_fx_px = 262.5"))
      << half.text();
  EXPECT_EQ(warningsOf(half), 1U) << half.text();
  EXPECT_EQ(half.proposed("calibration", "picture_cx_px"), "159.5");
  EXPECT_EQ(half.proposed("calibration", "label"), "kinect");
}

TEST(DeclaredFaults, AWrongLaserIsNotBlamedOnTheCamera) {
  const Checked turned(withFault(home(), {DeclaredFault::laser_yaw, 45}));
  EXPECT_TRUE(turned.says("problem: 'laser': is mounted otherwise than its sensor pose states")) << turned.text();
  EXPECT_FALSE(turned.says("'kinect': is turned")) << turned.text();
  const Checked mirrored(withFault(home(), {DeclaredFault::laser_sense}));
  EXPECT_FALSE(mirrored.says("mirror images")) << mirrored.text();
}

TEST(DeclaredFaults, OfTheWheelsClockIsCorrectedWhereLaserOdometryDoesNot) {
  const auto log = halfALap();
  const Checked little(withFault(log, {DeclaredFault::wheels_clock, 0.1}));
  EXPECT_TRUE(little.says("note: 'odometry' and 'laser': their clocks differ")) << little.text();
  EXPECT_EQ(little.proposed("mapper", "sensors"), "");
  const Checked much(withFault(log, {DeclaredFault::wheels_clock, 4.3}));
  EXPECT_TRUE(much.says("warning: 'odometry' and 'laser': their clocks differ")) << much.text();
  EXPECT_NEAR(std::stod(much.proposed("place_of_odometry", "clock_offset_s")), -4.3, 0.03);
  EXPECT_EQ(much.proposed("mapper", "window_s"), "") << "a window is no remedy for a clock";
}

TEST(DeclaredFaults, LogsWithoutStampsGetStampsAndNothingElse) {
  for (const double same : {0.0, 1.0}) {
    const Checked checked(withFault(halfALap(), {DeclaredFault::stamps, same}));
    EXPECT_EQ(checked.proposed("source", "step_s"), "0.1") << checked.text();
    EXPECT_EQ(checked.settings.size(), 1U) << toIni(checked.settings);
  }
}

/// What users of other programs reported, re-created as small logs: the words that --check must say.
class Reports : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Reports, AreNamed) {
  const auto [name, words] = GetParam();
  const auto path = testing::sharedData(std::string("reports/") + name + ".rawlog");
  if (!path) GTEST_SKIP() << "reports are not on this machine";
  const Checked checked(read(*path));
  EXPECT_TRUE(checked.says(words)) << checked.text();
}

INSTANTIATE_TEST_SUITE_P(
    OfUsers, Reports,
    ::testing::Values(std::pair("laser_clockwise_undeclared", "where the scans turn left, the odometry turns right"),
                      std::pair("odometry_left_right_swapped", "where the scans turn left, the odometry turns right"),
                      std::pair("spinning_laser_sweep_undeclared", "sweep_s = 0.10"),
                      std::pair("depth_x5", "the true depths are 0.2 times"),
                      std::pair("camera_yaw_10_off", "'kinect': is turned by -9.9"),
                      std::pair("camera_clock_0.3s_late", "problem: 'kinect' and 'laser': their clocks differ"),
                      std::pair("camera_negative_fy", "its focal length is not positive; set depth_fx_px"),
                      std::pair("camera_160x120_no_surfaces", "set [planes] noise_at_1m_m = 0.0046"),
                      std::pair("max_range_dropouts_valid", "single beams at the maximum range"),
                      std::pair("max_range_4m_declared_80", "problem: 'laser': 15 % of the valid beams measure"),
                      std::pair("no_stamps", "set [source] step_s"), std::pair("same_stamps", "set [source] step_s")));

}  // namespace
}  // namespace omnimapper::check::declared_faults_test
