#include <gtest/gtest.h>
#include <omnimapper/camera/PictureView.h>

namespace omnimapper::camera::picture_view_test {
namespace {

mrpt::img::TCamera camera() {
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(500, 400, 320, 240);
  return camera;
}

TEST(PixelOf, IsRightOfTheMiddleAndAboveForWhatIsRightAndAbove) {
  const auto pixel = pixelOf(camera(), {2, -0.4, 0.5});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 320 + 500 * 0.2, 1e-9);
  EXPECT_NEAR(pixel->y(), 240 - 400 * 0.25, 1e-9);
  EXPECT_FALSE(pixelOf(camera(), {-2, 0, 0}));
  EXPECT_FALSE(pixelOf(camera(), {0, 1, 0}));
}

TEST(PixelOf, FollowsTheLens) {
  auto lens = camera();
  lens.distortion = mrpt::img::DistortionModel::plumb_bob;
  lens.setDistortionPlumbBob(-0.2, 0, 0, 0);
  // 1 + k1 r^2 with r = 0.5.
  EXPECT_NEAR(pixelOf(lens, {1, -0.5, 0})->x(), 320 + 500 * 0.5 * 0.95, 1e-9);
}

TEST(PixelOf, OfACameraWithoutCalibrationIsNone) {
  EXPECT_FALSE(pixelOf(mrpt::img::TCamera(), {1, 0, 0}));
}

}  // namespace
}  // namespace omnimapper::camera::picture_view_test
