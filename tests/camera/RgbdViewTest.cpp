#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/RgbdView.h>

#include "RangeScans.h"

namespace omnimapper::camera::rgbd_view_test {
namespace {

using namespace scans;

// A wall 2 m ahead, without depths in the right half of the first row.
double wallWithGap(int x, int y) {
  return y == 0 && x >= kWidth / 2 ? 0 : 2;
}

TEST(RgbdView, APictureOfTheSameViewIsNotCopied) {
  auto scan = rangeScan(wallWithGap);
  addColours(scan);
  const RgbdView view(scan);
  EXPECT_EQ(view.depth().units(), scan.rangeImage.data());
  ASSERT_NE(view.colour(), nullptr);
  EXPECT_EQ(view.colour()->pixels, scan.intensityImage.ptrLine<std::uint8_t>(0));
}

TEST(RgbdView, APictureOfAnotherViewIsSeenFromTheDepthCameraAndOnlyConvertedOnce) {
  auto scan = rangeScan(wallWithGap);
  addColours(scan, 2 * kWidth, 2 * kHeight);
  const RgbdView view(scan);
  ASSERT_FALSE(view.colours().areOfDepthView());
  const ColourImage* picture = view.colour();
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->width, kWidth);
  EXPECT_EQ(picture->height, kHeight);
  const auto& colours = view.coloursOfDepths();
  EXPECT_EQ(picture->pixels, &colours.front().red);
  EXPECT_EQ(view.colour()->pixels, picture->pixels);
  EXPECT_EQ(&view.coloursOfDepths(), &colours);
  for (const int x : {0, kWidth / 2 - 2, kWidth / 2 + 2, kWidth - 1}) {
    const auto pixel = static_cast<std::size_t>(kWidth + x);
    EXPECT_EQ(colours[pixel], (x < kWidth / 2 ? obs::Rgb{200, 10, 20} : obs::Rgb{30, 220, 40})) << x;
    EXPECT_EQ(colours[pixel], *view.colours().at(x, 1, view.depth().at(pixel))) << x;
  }
  EXPECT_EQ(colours[kWidth - 1], obs::Rgb()) << "no depth";
}

TEST(RgbdView, WithoutAPictureThereAreNoColours) {
  const auto scan = rangeScan(wallWithGap);
  const RgbdView view(scan);
  EXPECT_EQ(view.colour(), nullptr);
  EXPECT_FALSE(view.colours().exist());
}

TEST(RgbdView, ACameraWithoutACalibrationIsRefusedByItsName) {
  auto scan = rangeScan(wallWithGap);
  scan.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  try {
    const RgbdView view(scan);
    FAIL() << "accepted";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("kinect"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::camera::rgbd_view_test
