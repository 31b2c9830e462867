#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/camera/DepthDistortion.h>

#include <cmath>
#include <limits>

#include "RangeScans.h"

namespace omnimapper::camera::depth_distortion_test {
namespace {

// A scan of 4 x 2 pixels in mm. Its columns are at x = -3/4, -1/4, 1/4, 3/4, its rows at y = -1/2, 1/2.
mrpt::obs::CObservation3DRangeScan smallScan(std::uint16_t units) {
  auto scan = scans::rangeScan([](int, int) { return 1.0; }, 4, 2);
  scan.rangeUnits = 0.001F;
  scan.rangeImage.fill(units);
  return scan;
}

TEST(DepthDistortion, HasTheNumberOfCoefficientsOfItsDegree) {
  EXPECT_EQ(DepthDistortion::termsOf(2), 3U);
  EXPECT_EQ(DepthDistortion::termsOf(3), 7U);
  EXPECT_EQ(DepthDistortion::termsOf(4), 12U);
  EXPECT_EQ(DepthDistortion::termsOf(8), 42U);
  EXPECT_EQ(DepthDistortion(std::vector<double>(12, 0.001)).degree(), 4);
  EXPECT_TRUE(DepthDistortion().isNone());
  EXPECT_TRUE(DepthDistortion(std::vector<double>()).isNone());
  for (const std::size_t count : {1, 2, 4, 11, 13, 43})
    EXPECT_THROW(DepthDistortion(std::vector<double>(count, 0.001)), base::Error) << count;
  EXPECT_THROW(DepthDistortion({0, std::numeric_limits<double>::quiet_NaN(), 0}), base::Error);
}

TEST(DepthDistortion, IsASumOfProductsOfLegendrePolynomials) {
  const double x = 0.5, y = -0.2;
  const double p2x = 0.5 * (3 * x * x - 1), p2y = 0.5 * (3 * y * y - 1);
  const double p3x = 0.5 * (5 * x * x * x - 3 * x), p3y = 0.5 * (5 * y * y * y - 3 * y);
  const std::vector<double> expected{p2x, x * y, p2y, p3x, p2x * y, x * p2y, p3y};
  std::vector<double> values(DepthDistortion::termsOf(3));
  DepthDistortion::evaluate(3, x, y, values.data());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-15) << i;
  EXPECT_NEAR(DepthDistortion({0.1, 0.2, 0.3}).at(x, y), 0.1 * p2x + 0.2 * x * y + 0.3 * p2y, 1e-15);
}

// s = 0.02 P2(x): P2(3/4) = 11/32 and P2(1/4) = -13/32, so that 1/2 m becomes 0.506875/m and 0.491875/m.
TEST(DepthDistortion, CorrectsDepthsAsComputedByHand) {
  auto scan = smallScan(2000);
  DepthDistortion({0.02, 0, 0}).applyTo(scan);
  for (int row = 0; row < 2; ++row) {
    EXPECT_EQ(scan.rangeImage(row, 0), 1973);
    EXPECT_EQ(scan.rangeImage(row, 1), 2033);
    EXPECT_EQ(scan.rangeImage(row, 2), 2033);
    EXPECT_EQ(scan.rangeImage(row, 3), 1973);
  }
  // s = 0.08 x y = 0.03 at the upper left: 1/4 m becomes 0.28/m, and 0.22/m at the upper right.
  scan = smallScan(4000);
  DepthDistortion({0, 0.08, 0}).applyTo(scan);
  EXPECT_EQ(scan.rangeImage(0, 0), 3571);
  EXPECT_EQ(scan.rangeImage(0, 3), 4545);
  EXPECT_EQ(scan.rangeImage(1, 0), 4545);
  EXPECT_EQ(scan.rangeImage(1, 3), 3571);
}

TEST(DepthDistortion, WhatWasNotMeasuredStaysSoAndInfinityIsNotMeasured) {
  auto scan = smallScan(0);
  scan.rangeImage(0, 1) = 65535;
  scan.rangeImage(1, 1) = 60000;  // 1/(60 m) less 0.0203/m is negative: beyond infinity
  scan.rangeImage(1, 2) = 1;      // 1000/m is hardly changed
  DepthDistortion({0.05, 0, 0}).applyTo(scan);
  EXPECT_EQ(scan.rangeImage(0, 0), 0);
  EXPECT_EQ(scan.rangeImage(0, 1), 65535);
  EXPECT_EQ(scan.rangeImage(1, 1), 0);
  EXPECT_EQ(scan.rangeImage(1, 2), 1);
  scan = smallScan(64000);  // 1/(64 m) less 0.00203/m is 1/(73.6 m), more than 16 bits hold
  DepthDistortion({0.005, 0, 0}).applyTo(scan);
  EXPECT_EQ(scan.rangeImage(0, 1), 0);
  EXPECT_EQ(scan.rangeImage(0, 0), 57658);
}

// Along a ray whose range is k times the depth, the inverse range and its error are 1/k of those of the depth.
TEST(DepthDistortion, OfRangesItIsAlongTheRay) {
  auto scan = smallScan(0);
  scan.range_is_depth = false;
  const auto& camera = scan.cameraParams;
  const double k = std::hypot(1, (3 - camera.cx()) / camera.fx(), (1 - camera.cy()) / camera.fy());
  const double s = 0.05 * 11 / 32;
  scan.rangeImage(1, 3) = static_cast<std::uint16_t>(std::lround(2000 * k));
  DepthDistortion({0.05, 0, 0}).applyTo(scan);
  EXPECT_EQ(scan.rangeImage(1, 3), std::lround(1000 * k / (0.5 + s)));
}

TEST(DepthDistortion, NothingIsDoneToScansWithoutDepthsAndPointsOfTheOldDepthsGo) {
  const DepthDistortion distortion({0.02, 0, 0});
  mrpt::obs::CObservation3DRangeScan empty;
  EXPECT_NO_THROW(distortion.applyTo(empty));
  auto scan = smallScan(2000);
  scan.hasPoints3D = true;
  scan.resizePoints3DVectors(8);
  DepthDistortion().applyTo(scan);
  EXPECT_TRUE(scan.hasPoints3D);
  EXPECT_EQ(scan.rangeImage(0, 0), 2000);
  distortion.applyTo(scan);
  EXPECT_FALSE(scan.hasPoints3D);
  EXPECT_TRUE(scan.points3D_x.empty());
}

TEST(DepthDistortion, IsMadeAnewForAnImageOfAnotherSize) {
  const DepthDistortion distortion({0.02, 0, 0});
  auto small = smallScan(2000), again = small;
  auto large = scans::rangeScan([](int, int) { return 2.0; }, 160, 120);
  distortion.applyTo(small);
  distortion.applyTo(large);
  distortion.applyTo(again);
  EXPECT_EQ(again.rangeImage(0, 0), small.rangeImage(0, 0));
  EXPECT_NEAR(large.rangeImage(0, 0) * 1e-4, 1 / (0.5 + distortion.at(-1 + 1.0 / 160, 0)), 1e-4);
}

TEST(DepthDistortion, OfAnIniItIsAppliedBeforeTheScale) {
  const auto calibration = CameraCalibration::read(
      base::Config::fromText("[calibration]\ndepth_scale = 1.1\ndepth_distortion_per_m = 0.02, 0 0\n", "test.ini"));
  auto scan = smallScan(2000);
  calibration.applyTo(scan);
  EXPECT_EQ(scan.rangeImage(0, 0), 1973);
  EXPECT_FLOAT_EQ(scan.rangeUnits, 0.0011F);
}

TEST(DepthDistortion, ABadOneOfAnIniIsRefusedByFileAndKey) {
  const auto code = [](const std::string& value, const std::string& expected) {
    try {
      CameraCalibration::read(
          base::Config::fromText("[calibration]\ndepth_distortion_per_m = " + value + "\n", "test.ini"));
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find("test.ini:1"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("depth_distortion_per_m"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
      return error.code();
    }
    return base::ExitCode::ok;
  };
  EXPECT_EQ(code("0.1, 0.2", "3, 7, 12"), base::ExitCode::out_of_range);
  EXPECT_EQ(code("0.1, 0.2, wide", "'wide'"), base::ExitCode::wrong_type);
  EXPECT_EQ(code("0.1, 0.2, nan", "'nan'"), base::ExitCode::wrong_type);
  EXPECT_EQ(code("0.1, 0.2, 3", "'3'"), base::ExitCode::out_of_range);
}

}  // namespace
}  // namespace omnimapper::camera::depth_distortion_test
