#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <limits>

namespace omnimapper::camera::lens_straightener_test {
namespace {

using mrpt::obs::CObservation3DRangeScan;

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocal = 130, kCx = 79.5, kCy = 59.5;

/// Scene along the ray (u, v, 1): the depth [m] of a slanted wall, and a brightness that changes slowly.
double depthAlong(double u, double v) {
  return 2 / (1 + 0.3 * u - 0.2 * v);
}
double brightnessAlong(double u, double v) {
  return 128 + 60 * std::sin(5 * u) * std::cos(4 * v);
}

/// Radial distortion of Freiburg1's lens as the TUM RGB-D benchmark calibrated it.
constexpr double kK1 = 0.2624, kK2 = -0.9531, kK3 = 1.1633;

/// Images with or without the distortion of the lens. For each pixel, the ray that it shows is searched.
CObservation3DRangeScan::Ptr wall(bool is_distorted) {
  auto scan = CObservation3DRangeScan::Create();
  scan->sensorLabel = "camera";
  scan->hasRangeImage = scan->hasIntensityImage = scan->range_is_depth = true;
  scan->rangeUnits = 1e-4F;
  scan->rangeImage_setSize(kHeight, kWidth);
  scan->intensityImage.resize(kWidth, kHeight, mrpt::img::CH_GRAY);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double distorted_u = (x - kCx) / kFocal, distorted_v = (y - kCy) / kFocal;
      double u = distorted_u, v = distorted_v;
      for (int i = 0; i < 50 && is_distorted; ++i) {
        const double r2 = u * u + v * v, stretch = 1 + r2 * (kK1 + r2 * (kK2 + r2 * kK3));
        u = distorted_u / stretch;
        v = distorted_v / stretch;
      }
      scan->rangeImage(y, x) = static_cast<std::uint16_t>(std::lround(1e4 * depthAlong(u, v)));
      *scan->intensityImage.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y)) =
          static_cast<std::uint8_t>(std::lround(brightnessAlong(u, v)));
    }
  }
  for (auto* camera : {&scan->cameraParams, &scan->cameraParamsIntensity}) {
    camera->ncols = kWidth;
    camera->nrows = kHeight;
    camera->setIntrinsicParamsFromValues(kFocal, kFocal, kCx, kCy);
    if (!is_distorted) continue;
    camera->distortion = mrpt::img::DistortionModel::plumb_bob;
    camera->dist[0] = kK1;
    camera->dist[1] = kK2;
    camera->dist[4] = kK3;
  }
  return scan;
}

TEST(LensStraightener, WhatItTakesOutIsWhatAPinholeSees) {
  LensStraightener lens;
  const auto distorted = wall(true), straight = wall(false);
  const auto made = lens.straightened(distorted);
  EXPECT_EQ(made->sensorLabel, "camera");
  EXPECT_EQ(made->cameraParams.dist[0], 0);
  double was_off = 0;
  int unseen = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (made->rangeImage(y, x) == 0) {
        ++unseen;
        continue;
      }
      was_off = std::max(was_off, std::abs(1e-4 * distorted->rangeImage(y, x) - 1e-4 * straight->rangeImage(y, x)));
      ASSERT_NEAR(1e-4 * made->rangeImage(y, x), 1e-4 * straight->rangeImage(y, x), 3e-4) << x << " " << y;
      const auto column = static_cast<unsigned>(x), row = static_cast<unsigned>(y);
      ASSERT_NEAR(*made->intensityImage.ptr<std::uint8_t>(column, row),
                  *straight->intensityImage.ptr<std::uint8_t>(column, row), 2.5)
          << x << " " << y;
    }
  }
  EXPECT_LT(unseen, kWidth * kHeight / 10) << "pixels at the border that the distorted image does not show";
  EXPECT_GT(was_off, 0.01) << "without the correction the images must differ";
}

TEST(LensStraightener, AnEdgeStaysAnEdgeAndWhatIsNoDepthStaysNone) {
  LensStraightener lens;
  auto distorted = wall(true);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      distorted->rangeImage(y, x) = x < 60 ? 10000 : x < 80 ? 0 : x < 100 ? 65535 : 20000;
  const auto made = lens.straightened(distorted);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int depth = made->rangeImage(y, x);
      ASSERT_TRUE(depth == 10000 || depth == 0 || depth == 65535 || depth == 20000) << depth;
    }
  }
}

TEST(LensStraightener, WithoutALensOrACalibrationTheImageIsTheOneThatCame) {
  LensStraightener lens;
  const auto straight = wall(false);
  EXPECT_EQ(lens.straightened(straight), straight);
  auto broken = wall(true);
  for (auto* camera : {&broken->cameraParams, &broken->cameraParamsIntensity})
    camera->dist[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lens.straightened(broken), broken);
  auto empty = CObservation3DRangeScan::Create();
  EXPECT_EQ(lens.straightened(empty), empty);
}

TEST(LensStraightener, APictureInAFileIsStraightenedAsOneInTheLogIsOrSaidToBeMissing) {
  const testing::ScratchFolder folder;
  LensStraightener lens;
  const auto distorted = wall(true), stored = wall(true);
  stored->intensityImage.saveToFile(folder / "picture.png");
  stored->intensityImage.setExternalStorage(folder / "picture.png");
  const auto expected = lens.straightened(distorted), made = lens.straightened(stored);
  ASSERT_FALSE(made->intensityImage.isExternallyStored());
  for (unsigned x = 0; x < kWidth; ++x)
    ASSERT_EQ(*made->intensityImage.ptr<std::uint8_t>(x, 20), *expected->intensityImage.ptr<std::uint8_t>(x, 20)) << x;
  const auto missing = wall(true);
  missing->intensityImage.setExternalStorage(folder / "none.png");
  EXPECT_THROW(lens.straightened(missing), base::Error);
}

TEST(LensStraightener, ALensBeyondReasonLeavesNoDepthsRatherThanWrongOnes) {
  LensStraightener lens;
  auto broken = wall(true);
  for (auto* camera : {&broken->cameraParams, &broken->cameraParamsIntensity}) camera->dist[0] = 1e6;
  const auto made = lens.straightened(broken);
  EXPECT_EQ(made->rangeImage(0, 0), 0);
  EXPECT_EQ(made->rangeImage(kHeight - 1, kWidth - 1), 0);
}

}  // namespace
}  // namespace omnimapper::camera::lens_straightener_test
