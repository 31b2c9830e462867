#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

namespace omnimapper::mapper::sensor_poses_test {
namespace {

using mrpt::poses::CPose3D;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

void expectNear(const CPose3D& a, const CPose3D& b) {
  const CPose3D difference = a - b;
  EXPECT_LT(difference.translation().norm(), 1e-9) << a << b;
  EXPECT_LT((difference.getRotationMatrix() - mrpt::math::CMatrixDouble33::Identity()).norm(), 1e-9) << a << b;
}

SensorPoses fromIni(const std::string& ini) {
  return {{"sensor"}, base::Config::fromText(ini, "test.ini")};
}

// Sensor poses of the label "laser" from a file with that text.
class TrackFile {
 public:
  explicit TrackFile(const std::string& text) { std::ofstream(path_) << text; }
  const std::string& path() const { return path_; }
  SensorPoses poses() const { return fromIni("[sensor]\nlabel = laser\npose_file = " + path_ + "\n"); }

 private:
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "laser.tum";
};

TEST(SensorPoses, AStaticPoseHoldsAtAnyTimeForItsLabelOnly) {
  const auto poses = fromIni(
      "[sensor]\nlabel = laser\npose_x_m = 0.2\npose_y_m = -0.1\npose_z_m = 0.3\npose_yaw_deg = 90\npose_roll_deg = "
      "180\n");
  const CPose3D expected(0.2, -0.1, 0.3, 90 * kDegree, 0, 180 * kDegree);
  for (const double seconds : {1.0, 1e9, 2e9}) {
    const auto pose = poses.find("laser", base::stampFromUnix(seconds));
    ASSERT_TRUE(pose);
    expectNear(*pose, expected);
  }
  EXPECT_FALSE(poses.find("other", base::stampFromUnix(1e9)));
}

TEST(SensorPoses, AnApertureIsGivenOrLeftAsTheScanHasIt) {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->aperture = 1.5F;
  scan->sensorPose = CPose3D(0.3, 0, 0, 0, 0, 0);
  const auto with = [&](const std::string& lines) {
    const auto applied_scan = fromIni("[sensor]\nlabel = laser\n" + lines).applied(scan);
    return std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(applied_scan);
  };
  const auto half = static_cast<float>(180 * kDegree);
  EXPECT_FLOAT_EQ(with("pose_x_m = 0.2\naperture_deg = 180\n")->aperture, half);
  EXPECT_EQ(with("pose_x_m = 0.2\naperture_deg = 180\n")->sensorPose.x(), 0.2);
  EXPECT_FLOAT_EQ(with("pose_x_m = 0.2\n")->aperture, 1.5F);
  EXPECT_FLOAT_EQ(with("aperture_deg = 180\n")->aperture, half);
  EXPECT_EQ(with("aperture_deg = 180\n")->sensorPose.x(), 0.3) << "its position is not given";
  EXPECT_EQ(scan->aperture, 1.5F);
}

TEST(SensorPoses, AClockIsOfTheSourceAndLeavesThePoseAsTheObservationHasIt) {
  const auto poses = fromIni("[sensor]\nlabel = laser\nclock_offset_s = -0.25\n");
  EXPECT_EQ(poses.clockOffsets(), (std::map<std::string, double>{{"laser", -0.25}}));
  EXPECT_FALSE(poses.find("laser", base::stampFromUnix(1e9)));
  const auto config = base::Config::fromText(
      "[mapper]\nsensors = a\n[a]\nlabel = wheels\nclock_offset_s = 4\n[source]\nend_s = 7\n", "test.ini");
  EXPECT_EQ(sourceOptions(config).clock_offsets, (std::map<std::string, double>{{"wheels", 4}}));
  EXPECT_EQ(sourceOptions(config).end, 7);
}

TEST(SensorPoses, GivesACopyAndLeavesTheObservationOfTheLogAlone) {
  const auto poses = fromIni("[sensor]\nlabel = laser\npose_x_m = 0.2\n");
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->timestamp = base::stampFromUnix(1e9);
  const auto moved = poses.applied(scan);
  EXPECT_NE(moved, scan);
  mrpt::poses::CPose3D base_from_sensor;
  moved->getSensorPose(base_from_sensor);
  EXPECT_EQ(base_from_sensor.x(), 0.2);
  EXPECT_EQ(scan->sensorPose.x(), 0);
  EXPECT_EQ(moved->timestamp, scan->timestamp);
  scan->sensorLabel = "other";
  EXPECT_EQ(poses.applied(scan), scan);
}

TEST(SensorPoses, ACalibrationIsOfACopyAndOfCamerasWithDepthsAlone) {
  const SensorPoses poses({}, base::Config::fromText("[calibration]\nlabel = camera\ndepth_fx_px = 517\n", "test.ini"));
  auto camera = mrpt::obs::CObservation3DRangeScan::Create();
  camera->sensorLabel = "camera";
  const double of_the_log = camera->cameraParams.fx();
  const auto calibrated = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(poses.applied(camera));
  ASSERT_TRUE(calibrated);
  EXPECT_NE(calibrated, camera);
  EXPECT_EQ(calibrated->cameraParams.fx(), 517);
  EXPECT_EQ(camera->cameraParams.fx(), of_the_log);
  camera->sensorLabel = "other";
  EXPECT_EQ(poses.applied(camera), camera);
  auto laser = mrpt::obs::CObservation2DRangeScan::Create();
  laser->sensorLabel = "camera";
  EXPECT_EQ(poses.applied(laser), laser);
}

TEST(SensorPoses, AMovingSensorIsInterpolatedAndHeldBeyondTheEnds) {
  // A tilting laser: it moves from level to 90 deg nose down in two seconds, and up by 1 m.
  const TrackFile file(
      "# stamp x y z qx qy qz qw\n"
      "1000000002.0 0 0 1 0 0.70710678118654752 0 0.70710678118654752\n"
      "\n"
      "1000000000.0 0 0 0 0 0 0 1\n");
  const auto poses = file.poses();
  const auto at = [&](double seconds) { return *poses.find("laser", base::stampFromUnix(1e9 + seconds)); };
  expectNear(at(-5), CPose3D());
  expectNear(at(0), CPose3D());
  expectNear(at(0.5), CPose3D(0, 0, 0.25, 0, 22.5 * kDegree, 0));
  expectNear(at(1), CPose3D(0, 0, 0.5, 0, 45 * kDegree, 0));
  expectNear(at(2), CPose3D(0, 0, 1, 0, 90 * kDegree, 0));
  expectNear(at(100), CPose3D(0, 0, 1, 0, 90 * kDegree, 0));
}

TEST(SensorPoses, BadFilesAreRefusedByFileAndLine) {
  const std::string good = "1000000000.0 0 0 0 0 0 0 1\n";
  for (const std::string bad :
       {"1000000001.0 0 0 0 0 0 1\n", "1000000001.0 0 0 zero 0 0 0 1\n", "1000000001.0 0 0 nan 0 0 0 1\n",
        "1000000001.0 0 0 0 0 0 0 0\n", "1000000001.0 0 0 0 1 1 1 1\n", "yesterday 0 0 0 0 0 0 1\n",
        "1000000000.0 1 0 0 0 0 0 1\n"}) {
    const TrackFile file(good + bad);
    try {
      file.poses();
      ADD_FAILURE() << bad << "was read";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << bad;
      EXPECT_NE(std::string(error.what()).find(file.path() + ":2"), std::string::npos) << error.what();
    }
  }
}

TEST(SensorPoses, MissingAndEmptyFilesAreRefusedByName) {
  const TrackFile empty("# nothing\n");
  for (const std::string& path : {empty.path(), std::string("/no/such/file.tum")}) {
    try {
      fromIni("[sensor]\nlabel = laser\npose_file = " + path + "\n");
      ADD_FAILURE() << path << " was read";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  }
}

TEST(SensorPoses, ASectionWithoutLabelIsRefused) {
  try {
    fromIni("[sensor]\npose_x_m = 0.2\n");
    ADD_FAILURE() << "whose pose is it?";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("[sensor]"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("label"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::mapper::sensor_poses_test
