#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Angle.h>

#include <array>

#include "PlateRanges.h"

namespace omnimapper::signs {
namespace {

constexpr double kDegree = geometry::kPi / 180;

mrpt::img::TCamera camera() {
  mrpt::img::TCamera camera;
  camera.ncols = 640;
  camera.nrows = 480;
  camera.setIntrinsicParamsFromValues(500, 500, 320, 240);
  return camera;
}

// A wall square to the view, `depth` [mm] away; the picture's camera is `right` [m] beside the depth camera.
mrpt::obs::CObservation3DRangeScan wall(std::uint16_t depth, double right = 0) {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.hasRangeImage = scan.hasIntensityImage = true;
  scan.range_is_depth = true;
  scan.rangeUnits = 0.001F;
  scan.rangeImage_setSize(480, 640);
  scan.rangeImage.fill(depth);
  scan.cameraParams = scan.cameraParamsIntensity = camera();
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -right, 0, -90 * kDegree, 0, -90 * kDegree);
  scan.intensityImage.resize(640, 480, mrpt::img::CH_RGB);
  return scan;
}

const Corners kPlate = {Eigen::Vector2f(400, 200), {460, 200}, {460, 240}, {400, 240}};

std::optional<PlateRange> rangeOf(const mrpt::obs::CObservation3DRangeScan& scan) {
  const Eigen::Vector3d ray = Eigen::Vector3d((430. - 320) / 500, (220. - 240) / 500, 1).normalized();
  return PlateRanges(scan, camera::LensModel(camera(), "kinect")).of(kPlate, ray);
}

// At a depth of 2 m, the ray to (430, 220) px is 2 sqrt(1 + 0.22^2 + 0.04^2) = 2.0494 m long.
TEST(PlateRanges, areLengthsOfRaysAsWorkedByHand) {
  for (const double right : {0., 0.025}) {
    const auto found = rangeOf(wall(2000, right));
    ASSERT_TRUE(found) << right;
    EXPECT_NEAR(found->range, 2.0494, 0.0002) << right;
    EXPECT_GT(found->sigma, 0.01 * 2.0494) << "the scale of a depth camera is known to one percent";
    EXPECT_LT(found->sigma, 0.03 * 2.0494);
  }
}

// If the image holds ranges along the rays, those of the same wall are longer off the middle.
TEST(PlateRanges, takeRangesForRanges) {
  auto scan = wall(2049);
  scan.range_is_depth = false;
  const auto found = rangeOf(scan);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->range, 2.049, 0.003);
}

// The depth camera sees the plate in other columns than the picture does; everything to the left of the plate is 9 m
// away.
TEST(PlateRanges, areOfThePlateWhereThePictureShowsIt) {
  auto scan = wall(3000, 0.3);  // 0.3 m to the right: what is at column 430 of the picture is at 480 of the depths
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 445; ++column) scan.rangeImage(row, column) = 9000;
  const auto found = rangeOf(scan);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->range, 1.5 * 2.0494, 0.001);
}

TEST(PlateRanges, areNoneWhereLittleOrManyThingsAreSeen) {
  EXPECT_FALSE(rangeOf(wall(0))) << "no depth";
  EXPECT_FALSE(rangeOf(wall(65535))) << "saturated";
  auto strips = wall(2000);
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 640; ++column)
      strips.rangeImage(row, column) = std::array<std::uint16_t, 3>{800, 2000, 4000}[column / 4 % 3];
  EXPECT_FALSE(rangeOf(strips));
  mrpt::obs::CObservation3DRangeScan picture_alone = wall(2000);
  picture_alone.hasRangeImage = false;
  EXPECT_FALSE(rangeOf(picture_alone));
}

}  // namespace
}  // namespace omnimapper::signs
