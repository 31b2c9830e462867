#include <gtest/gtest.h>

#include "TableWorld.h"
#include "object_landmarks/ObjectMeasurement.h"

namespace omnimapper::plugins::object_measurement_test {
namespace {

using namespace table_world;

TEST(ObjectMeasurements, AreInTheBaseAndStandOnTheirSurface) {
  TableWorld world;
  world.things = {onTable(0.1, 1.2, {0.2, 0.2, 0.2})};
  const auto objects = world.seen({}, 0).second;
  std::size_t dropped = 0;
  const auto all = objectMeasurements(*objects, {0, 7}, {}, {}, dropped);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(dropped, 0U);
  EXPECT_TRUE(all[0].why_useless.empty());
  EXPECT_LT((all[0].middle - Vector3d(0.1, 1.2, 0.8)).norm(), 0.04);
  EXPECT_EQ(all[0].sensor_label, "kinect");
  EXPECT_EQ(all[0].view.frame, (base::KeyFrameId{0, 7}));
  EXPECT_NEAR(all[0].view.up.z(), 1, 1e-6);
  ASSERT_TRUE(all[0].view.foot);
  EXPECT_NEAR(all[0].view.foot->z(), 0.7, 0.01);
  for (const auto& point : all[0].view.points) EXPECT_GT(point.z(), 0.69F);
}

TEST(ObjectMeasurements, OfTooManyAreTheLargest) {
  TableWorld world;
  world.things = {onTable(-0.3, 1.2, {0.1, 0.1, 0.1}), onTable(0, 1.2, {0.2, 0.2, 0.2}),
                  onTable(0.3, 1.2, {0.1, 0.1, 0.1})};
  const auto objects = world.seen({}, 0).second;
  ObjectLandmarksOptions options;
  options.max_per_image = 1;
  std::size_t dropped = 0;
  const auto all = objectMeasurements(*objects, {}, {}, options, dropped);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(dropped, 2U);
  EXPECT_GT(all[0].size.z(), 0.15);
}

// Along the sides of a box of 1 x 2 x 4 m that is turned by 90 degrees: the first side is along y.
TEST(ObjectMeasurements, TheMiddleIsUncertainByAShareOfTheSides) {
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(EIGEN_PI / 2, Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d covariance = covarianceOfPart(axes, {1, 2, 4}, 0.15);
  EXPECT_NEAR(covariance(0, 0), 0.09, 1e-9);
  EXPECT_NEAR(covariance(1, 1), 0.0225, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 0.36, 1e-9);
}

}  // namespace
}  // namespace omnimapper::plugins::object_measurement_test
