#include <gtest/gtest.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include "../camera/RangeScans.h"

namespace omnimapper::perception::range_scan_test {
namespace {

using namespace camera::scans;

const auto kWall = [](int, int) { return 2.; };

TEST(RangeScan, APictureOfAnotherFocalLengthIsNotReadPixelByPixel) {
  // The picture's focal length is 580 px, that of the depth 525 px, and its middle is 20 px farther left. It is red
  // left of column 80.
  auto scan = rangeScan(kWall);
  scan.cameraParams = camera::scans::camera(kWidth, kHeight, 525);
  addColours(scan);
  scan.cameraParamsIntensity.setIntrinsicParamsFromValues(580, 580, 0.5 * (kWidth - 1) - 20, 0.5 * (kHeight - 1));
  const camera::ScanDepth depth(scan);
  const camera::ScanColours colours(scan);
  EXPECT_FALSE(colours.areOfDepthView());
  const int row = kHeight / 2, column = 130;
  const auto place = colours.placeOf(column, row, 2);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->x, static_cast<int>((column - 79.5) / 525 * 580 + 59.5 + 0.5));
  EXPECT_EQ(colours.at(column, row, 2)->green, 220);
  EXPECT_EQ(colours.at(column - 40, row, 2)->red, 200) << "green, pixel by pixel";
  scan.cameraParamsIntensity = scan.cameraParams;
  EXPECT_TRUE(camera::ScanColours(scan).areOfDepthView());
  scan.cameraParamsIntensity.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_TRUE(camera::ScanColours(scan).areOfDepthView()) << "not calibrated";
}

TEST(RangeScan, PicturesOfTwoOrFourChannelsAreNone) {
  auto scan = rangeScan(kWall);
  addColours(scan);
  EXPECT_TRUE(PlaneExtractor({}, {}).extract(scan)->planes.at(0).colour);
  for (const int channels : {2, 4}) {
    scan.intensityImage.resize(kWidth, kHeight, static_cast<mrpt::img::TImageChannels>(channels));
    ASSERT_EQ(static_cast<int>(scan.intensityImage.channelCount()), channels);
    EXPECT_FALSE(camera::ScanColours(scan).exist()) << channels;
    EXPECT_FALSE(PlaneExtractor({}, {}).extract(scan)->planes.at(0).colour);
  }
}

}  // namespace
}  // namespace omnimapper::perception::range_scan_test
