#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/CameraCalibration.h>

#include <cmath>

namespace omnimapper::camera::camera_calibration_test {
namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;

CameraCalibration fromIni(const std::string& ini) {
  return CameraCalibration::read(base::Config::fromText(ini, "test.ini"));
}

mrpt::obs::CObservation3DRangeScan camera() {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = "camera";
  scan.rangeUnits = 0.001F;
  for (auto* one : {&scan.cameraParams, &scan.cameraParamsIntensity})
    one->setIntrinsicParamsFromValues(525, 526, 320, 240);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -0.02, 0, -90 * kDegree, 0, -90 * kDegree);
  return scan;
}

mrpt::obs::CObservation3DRangeScan changed(const std::string& keys) {
  auto scan = camera();
  fromIni("[calibration]\n" + keys).applyTo(scan);
  return scan;
}

TEST(CameraCalibration, AParameterThatIsNotGivenStaysAsTheLogHasIt) {
  const auto scan = changed("picture_fx_px = 517.3\npicture_k2 = -0.9\n");
  EXPECT_EQ(scan.cameraParamsIntensity.fx(), 517.3);
  EXPECT_EQ(scan.cameraParamsIntensity.fy(), 526);
  EXPECT_EQ(scan.cameraParamsIntensity.dist[1], -0.9);
  EXPECT_EQ(scan.cameraParamsIntensity.dist[0], 0);
  EXPECT_EQ(scan.cameraParamsIntensity.distortion, mrpt::img::DistortionModel::plumb_bob);
  EXPECT_EQ(scan.cameraParams, camera().cameraParams);
  EXPECT_EQ(scan.relativePoseIntensityWRTDepth.y(), -0.02);
  EXPECT_EQ(scan.rangeUnits, 0.001F);
}

TEST(CameraCalibration, MirrorImagesAreMirroredBackAndRangesAreNoDepths) {
  auto scan = camera();
  scan.hasRangeImage = true;
  scan.range_is_depth = true;
  scan.rangeImage_setSize(2, 3);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column)
      scan.rangeImage(row, column) = static_cast<std::uint16_t>(10 * row + column);
  }
  auto same = scan;
  fromIni("[calibration]\ndepth_is_range = true\n").applyTo(same);
  EXPECT_FALSE(same.range_is_depth);
  EXPECT_EQ(same.rangeImage(1, 0), 10);
  fromIni("[calibration]\nmirrored = true\n").applyTo(scan);
  EXPECT_TRUE(scan.range_is_depth);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) EXPECT_EQ(scan.rangeImage(row, column), 10 * row + 2 - column);
  }
  EXPECT_EQ(scan.cameraParams, camera().cameraParams);
}

TEST(CameraCalibration, EveryKeyHasItsPlace) {
  const auto scan = changed(
      "depth_fx_px = 1\ndepth_fy_px = 2\ndepth_cx_px = 3\ndepth_cy_px = 4\n"
      "depth_k1 = 5\ndepth_k2 = 6\ndepth_p1 = 7\ndepth_p2 = 8\ndepth_k3 = 9\n"
      "picture_fx_px = 11\npicture_fy_px = 12\npicture_cx_px = 13\npicture_cy_px = 14\n"
      "picture_k1 = 15\npicture_k2 = 16\npicture_p1 = 17\npicture_p2 = 18\npicture_k3 = 19\ndepth_scale = 1.035\n"
      "picture_x_m = 0.1\npicture_y_m = 0.2\npicture_z_m = 0.3\n"
      "picture_yaw_deg = 4\npicture_pitch_deg = 5\npicture_roll_deg = 6\n");
  double offset = 0;
  for (const auto* one : {&scan.cameraParams, &scan.cameraParamsIntensity}) {
    EXPECT_EQ(one->fx(), offset + 1);
    EXPECT_EQ(one->fy(), offset + 2);
    EXPECT_EQ(one->cx(), offset + 3);
    EXPECT_EQ(one->cy(), offset + 4);
    EXPECT_EQ(one->k1(), offset + 5);
    EXPECT_EQ(one->k2(), offset + 6);
    EXPECT_EQ(one->p1(), offset + 7);
    EXPECT_EQ(one->p2(), offset + 8);
    EXPECT_EQ(one->k3(), offset + 9);
    offset += 10;
  }
  EXPECT_FLOAT_EQ(scan.rangeUnits, 0.001035F);
  const auto& pose = scan.relativePoseIntensityWRTDepth;
  EXPECT_EQ(pose.x(), 0.1);
  EXPECT_EQ(pose.y(), 0.2);
  EXPECT_EQ(pose.z(), 0.3);
  EXPECT_NEAR(pose.yaw(), 4 * kDegree, 1e-12);
  EXPECT_NEAR(pose.pitch(), 5 * kDegree, 1e-12);
  EXPECT_NEAR(pose.roll(), 6 * kDegree, 1e-12);
}

TEST(CameraCalibration, OnlyTheCameraOfThatLabelIsMeant) {
  EXPECT_FALSE(fromIni("").isOf("camera"));
  EXPECT_TRUE(fromIni("[calibration]\ndepth_scale = 1.01\n").isOf("camera"));
  const auto labelled = fromIni("[calibration]\nlabel = camera\n");
  EXPECT_TRUE(labelled.isOf("camera"));
  EXPECT_FALSE(labelled.isOf("other"));
}

TEST(CameraCalibration, OfAFisheyeLensNothingIsKeptWhereAnotherLensIsGiven) {
  auto scan = camera();
  scan.cameraParams.distortion = mrpt::img::DistortionModel::kannala_brandt;
  scan.cameraParams.dist[5] = 1;
  fromIni("[calibration]\ndepth_k1 = 0.2\n").applyTo(scan);
  EXPECT_EQ(scan.cameraParams.distortion, mrpt::img::DistortionModel::plumb_bob);
  EXPECT_EQ(scan.cameraParams.dist[0], 0.2);
  EXPECT_EQ(scan.cameraParams.dist[5], 0);
}

TEST(CameraCalibration, BadValuesAreRefusedByFileAndKey) {
  const auto message = [](const std::string& keys) {
    try {
      fromIni("[calibration]\n" + keys);
    } catch (const base::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::string bad : {"depth_fx_px = 0", "depth_scale = -1", "picture_k1 = nan", "picture_cx_px = wide"}) {
    const auto text = message(bad + "\n");
    EXPECT_NE(text.find("test.ini"), std::string::npos) << bad << ": " << text;
    EXPECT_NE(text.find(bad.substr(0, bad.find(' '))), std::string::npos) << bad << ": " << text;
  }
  EXPECT_NE(message("depth_focal = 500\n").find("depth_focal"), std::string::npos);
  const auto part = message("picture_x_m = 0.1\n");
  EXPECT_NE(part.find("test.ini:1"), std::string::npos) << part;
  EXPECT_NE(part.find("picture_roll_deg"), std::string::npos) << part;
}

}  // namespace
}  // namespace omnimapper::camera::camera_calibration_test
