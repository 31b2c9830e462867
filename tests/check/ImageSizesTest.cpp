#include <gtest/gtest.h>

#include "ImageSizes.h"

namespace omnimapper::check::image_sizes_test {
namespace {

mrpt::img::TCamera camera(double focal, double cx, double cy, unsigned columns, unsigned rows) {
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(focal, focal, cx, cy);
  camera.ncols = columns;
  camera.nrows = rows;
  return camera;
}

TEST(ImageSizes, TheSizeOfTheCalibrationIsFoundWhateverTheLogStates) {
  const auto kinect = camera(525, 319.5, 239.5, 640, 480);
  EXPECT_FALSE(otherCalibratedSize(kinect, 640, 480));
  EXPECT_EQ(otherCalibratedSize(kinect, 320, 240), std::pair(640.0, 480.0));
  EXPECT_EQ(otherCalibratedSize(kinect, 1280, 960), std::pair(640.0, 480.0));
  EXPECT_EQ(otherCalibratedSize(kinect, 512, 384), std::pair(640.0, 480.0));
  // The stated size is that of the images, but the axis is not in their middle.
  EXPECT_EQ(otherCalibratedSize(camera(525, 319.5, 239.5, 320, 240), 320, 240), std::pair(640.0, 480.0));
}

TEST(ImageSizes, ADefaultSizeOrACroppedImageIsNoContradiction) {
  EXPECT_FALSE(otherCalibratedSize(camera(262.5, 159.5, 119.5, 640, 480), 320, 240)) << "MRPT's default";
  EXPECT_FALSE(otherCalibratedSize(camera(525, 319.5, 239.5, 640, 480), 632, 474)) << "cropped";
  EXPECT_FALSE(otherCalibratedSize(camera(481.2, 319.5, 239.5, 640, 480), 640, 480)) << "ICL";
  EXPECT_FALSE(otherCalibratedSize(camera(0, 0, 0, 640, 480), 320, 240)) << "not calibrated";
  EXPECT_FALSE(otherCalibratedSize(camera(600, 400, 200, 640, 480), 640, 480)) << "an axis off the middle";
}

}  // namespace
}  // namespace omnimapper::check::image_sizes_test
