#include <gtest/gtest.h>
#include <omnimapper/drivers/KinectConversion.h>

#include <cmath>
#include <vector>

#include "kinect/KinectLens.h"

namespace omnimapper::drivers::kinect_conversion_test {
namespace {

using Registration = KinectOptions::Registration;
constexpr std::size_t kPixels = 640 * 480;

std::size_t at(int column, int row) {
  return static_cast<std::size_t>(row) * 640 + static_cast<std::size_t>(column);
}

// Two cameras with round numbers and no lens distortion, the colour camera 2.5 cm to the right.
KinectOptions plain(Registration registration = Registration::ours) {
  KinectOptions options;
  options.depth_k1 = options.depth_k2 = options.depth_p1 = options.depth_p2 = options.depth_k3 = 0;
  options.picture_k1 = options.picture_k2 = options.picture_p1 = options.picture_p2 = options.picture_k3 = 0;
  options.depth_fx = options.depth_fy = 600;
  options.depth_cx = 320;
  options.depth_cy = 240;
  options.picture_fx = options.picture_fy = 500;
  options.picture_cx = 310;
  options.picture_cy = 250;
  options.registration = registration;
  return options;
}

TEST(KinectConversion, rawValuesAreDepthsWorkedByHand) {
  const KinectCalibration calibration;
  EXPECT_NEAR(calibration.depthOf(0), 0.300215, 1e-6);     // 1 / 3.3309495161
  EXPECT_NEAR(calibration.depthOf(600), 0.671913, 1e-6);   // 1 / (3.3309495161 - 600 * 0.0030711016)
  EXPECT_NEAR(calibration.depthOf(1000), 3.848405, 1e-6);  // 1 / 0.2598479161
  EXPECT_EQ(calibration.depthOf(1085), 0) << "beyond infinity";
  EXPECT_EQ(calibration.depthOf(2047), 0) << "the device's value for no depth";
  EXPECT_EQ(calibration.depthOf(-1), 0);
  EXPECT_EQ(calibration.depthOf(2048), 0);
}

TEST(KinectConversion, theInverseIsTheNearestRawValue) {
  const KinectCalibration calibration;
  for (int raw = 0; raw < 1084; ++raw) EXPECT_EQ(calibration.rawOf(calibration.depthOf(raw)), raw);
  for (double depth = 0.31; depth < 10; depth += 0.0137) {
    const double step = depth * depth * 0.0030711016;  // the interval of one raw value
    EXPECT_NEAR(calibration.depthOf(calibration.rawOf(depth)), depth, 0.52 * step) << depth;
  }
  EXPECT_EQ(calibration.rawOf(0), 2047);
  EXPECT_EQ(calibration.rawOf(0.2), 2047) << "nearer than the raw value 0";
  EXPECT_EQ(calibration.rawOf(NAN), 2047);
}

TEST(KinectConversion, theColourCameraSeesAPointWorkedByHand) {
  // At 2 m the pixel (440, 300) is 0.4 m to the right and 0.2 m below, and 0.375 m to the right of the colour camera:
  // 310 + 500 * 0.1875 and 250 + 500 * 0.1.
  const auto place = KinectConversion(plain(Registration::none)).placeInPicture(440, 300, 2);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->column, 404);  // 403.75
  EXPECT_EQ(place->row, 300);
  EXPECT_NEAR(place->depth, 2, 1e-6);
  // From a colour camera 10 cm in front of it that is turned by 0.1 rad to the left, the point is 0.375 cos - 1.9 sin
  // ... to the right of the axis.
  auto turned = plain(Registration::none);
  turned.picture_x = 0.1;
  turned.picture_yaw += 0.1;
  const auto other = KinectConversion(turned).placeInPicture(440, 300, 2);
  ASSERT_TRUE(other);
  const double forward = 1.9 * std::cos(0.1) - 0.375 * std::sin(0.1);
  const double right = 0.375 * std::cos(0.1) + 1.9 * std::sin(0.1);
  EXPECT_NEAR(other->depth, forward, 1e-6);
  EXPECT_EQ(other->column, std::lround(310 + 500 * right / forward));
  EXPECT_EQ(other->row, std::lround(250 + 500 * 0.2 / forward));
  EXPECT_FALSE(KinectConversion(plain(Registration::none)).placeInPicture(0, 240, 0.2)) << "left of the picture";
}

TEST(KinectConversion, depthsAreMovedIntoThePictureAndTheNearestCounts) {
  std::vector<std::uint16_t> raw(kPixels, 2047);
  const KinectCalibration calibration;
  const int far = calibration.rawOf(4), near = calibration.rawOf(2);
  raw[at(440, 300)] = static_cast<std::uint16_t>(near);
  // At 4 m the pixel (436, 300) is 0.773 m to the right, and 0.748 m from the colour camera: 310 + 500 * 0.187 = 403.5.
  raw[at(437, 300)] = static_cast<std::uint16_t>(far);
  const std::vector<std::uint8_t> picture(3 * kPixels, 7);
  const auto scan = KinectConversion(plain()).observation(raw.data(), picture.data());
  int count = 0;
  for (const auto units : scan->rangeImage) count += units > 0;
  EXPECT_EQ(count, 1);
  EXPECT_NEAR(scan->rangeImage(300, 404) * static_cast<double>(scan->rangeUnits), calibration.depthOf(near), 1.01e-4);
  EXPECT_TRUE(scan->doDepthAndIntensityCamerasCoincide());
  EXPECT_EQ(scan->cameraParams.fx(), 500);
  EXPECT_NEAR(scan->sensorPose.y(), -0.025, 1e-12) << "the sensor is the colour camera now";
  EXPECT_NEAR(scan->sensorPose.yaw(), 0, 1e-12);
}

TEST(KinectConversion, withoutRegistrationAllIsAsTheCamerasSeeIt) {
  std::vector<std::uint16_t> raw(kPixels, 2047);
  for (std::size_t i = 0; i < kPixels; ++i) raw[i] = static_cast<std::uint16_t>(i % 2048);
  std::vector<std::uint8_t> picture(3 * kPixels, 0);
  picture[3 * at(5, 2)] = 200;  // red
  auto options = plain(Registration::none);
  options.max_range = 5;
  options.pose_z = 1.1;
  const auto scan = KinectConversion(options).observation(raw.data(), picture.data());
  EXPECT_EQ(scan->rangeImage(0, 0), std::lround(options.depthOf(0) / 0.0002));
  EXPECT_NEAR(scan->rangeImage(0, 600) * static_cast<double>(scan->rangeUnits), 0.671913, 1.01e-4);
  EXPECT_EQ(scan->rangeImage(1, 1030 - 640), 0) << "5.96 m is beyond max_range_m";
  EXPECT_EQ(scan->rangeImage(3, 2047 - 3 * 640), 0);
  EXPECT_EQ(scan->intensityImage.at<std::uint8_t>(5, 2, 2), 200) << "blue is first";
  EXPECT_EQ(scan->cameraParams.fx(), 600);
  EXPECT_EQ(scan->cameraParamsIntensity.fx(), 500);
  EXPECT_EQ(scan->relativePoseIntensityWRTDepth.y(), -0.025);
  EXPECT_EQ(scan->sensorPose.z(), 1.1);
}

TEST(KinectConversion, camerasThatSeeTheSameNeedNoRegistration) {
  auto options = plain();
  options.picture_fx = options.picture_fy = 600;
  options.picture_cx = 320;
  options.picture_cy = 240;
  options.picture_y = 0;
  std::vector<std::uint16_t> raw(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) raw[i] = static_cast<std::uint16_t>(300 + i % 700);
  const std::vector<std::uint8_t> picture(3 * kPixels, 7);
  const auto ours = KinectConversion(options).observation(raw.data(), picture.data());
  options.registration = Registration::none;
  const auto none = KinectConversion(options).observation(raw.data(), picture.data());
  EXPECT_TRUE(ours->rangeImage == none->rangeImage);
}

TEST(KinectConversion, theDevicesOwnRegistrationIsInMillimetresOfThePicture) {
  std::vector<std::uint16_t> millimetres(kPixels, 0);
  millimetres[at(100, 50)] = 1234;
  millimetres[at(101, 50)] = 10001;
  const auto scan = KinectConversion(plain(Registration::device)).observation(millimetres.data(), nullptr);
  EXPECT_EQ(scan->rangeImage(50, 100), 6170);  // of 0.2 mm
  EXPECT_EQ(scan->rangeImage(50, 101), 0);
  EXPECT_EQ(scan->rangeImage(50, 102), 0);
  EXPECT_FALSE(scan->hasIntensityImage);
  EXPECT_EQ(scan->cameraParams.fx(), 500);
}

TEST(KinectConversion, aLensIsUndone) {
  const KinectOptions options;
  for (const auto& camera : {options.depthCamera(), options.pictureCamera()}) {
    for (int row = 0; row < 480; row += 40) {
      for (int column = 0; column < 640; column += 40) {
        const NormalizedPoint image{(column - camera.cx()) / camera.fx(), (row - camera.cy()) / camera.fy()};
        const auto direction = undistort(camera, image);
        ASSERT_TRUE(direction) << column << " " << row;
        const NormalizedPoint again = distort(camera, *direction);
        EXPECT_NEAR(again.x, image.x, 1e-7);
        EXPECT_NEAR(again.y, image.y, 1e-7);
      }
    }
  }
  // x = 0.2, y = 0.1, r^2 = 0.05: radial 1 + 0.1 * 0.05 = 1.005, tangential x 2 * 0.01 * 0.02 + 0.02 * (0.05 + 0.08).
  mrpt::img::TCamera camera;
  camera.dist = {0.1, 0, 0.01, 0.02, 0, 0, 0, 0};
  const NormalizedPoint image = distort(camera, {0.2, 0.1});
  EXPECT_NEAR(image.x, 0.2 * 1.005 + 0.0004 + 0.0026, 1e-12);
  EXPECT_NEAR(image.y, 0.1 * 1.005 + 0.01 * 0.07 + 2 * 0.02 * 0.02, 1e-12);
}

}  // namespace
}  // namespace omnimapper::drivers::kinect_conversion_test
