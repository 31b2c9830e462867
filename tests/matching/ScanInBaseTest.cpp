#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <omnimapper/matching/ScanInBase.h>

#include <cmath>
#include <limits>

namespace omnimapper::matching::scan_in_base_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Points to the right of the sensor, ahead of it and to its left.
mrpt::obs::CObservationPointCloud threePoints(const mrpt::poses::CPose3D& base_from_sensor) {
  mrpt::obs::CObservationPointCloud cloud;
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPointFast(0, -1, 0);
  points->insertPointFast(2, 0, 0);
  points->insertPointFast(0, 1, 0);
  cloud.pointcloud = points;
  cloud.sensorPose = base_from_sensor;
  return cloud;
}

void expectPoints(const matching::ScanWithNormals& scan, const std::vector<Eigen::Vector2f>& expected) {
  ASSERT_EQ(scan.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LT((scan.points[i] - expected[i]).norm(), 1e-6) << i;
}

TEST(ScanInBase, PointsArePutWhereTheSensorIsAndWhatIsNotFiniteIsLeftOut) {
  auto cloud = threePoints({0.5, 0, 0.3, kPi / 2, 0, 0});
  cloud.pointcloud->insertPointFast(kNan, 1, 0);
  expectPoints(scanInBase(cloud), {{1.5, 0}, {0.5, 2}, {-0.5, 0}});
}

TEST(ScanInBase, TheTiltIsThatOfThePlaneWhicheverSideIsUp) {
  for (const double roll : {0.0, kPi}) {
    EXPECT_NEAR(tiltOf({1, 2, 3, 0.7, 0, roll}), 0, 1e-7);
    EXPECT_NEAR(tiltOf({1, 2, 3, 0.7, 0.3, roll}), 0.3, 1e-9);
    EXPECT_NEAR(tiltOf({1, 2, 3, -2, 0, roll - 0.4}), 0.4, 1e-9);
  }
  EXPECT_NEAR(tiltOf({0, 0, 0, 0, 0, kPi / 2}), kPi / 2, 1e-9);
}

TEST(ScanInBase, AnUpsideDownSensorSeesItsLeftOnTheRight) {
  expectPoints(scanInBase(threePoints({0, 0, 0.3, 0, 0, kPi})), {{0, 1}, {2, 0}, {0, -1}});
}

TEST(ScanInBase, ASweepMovesItsEndsHalfItsMotionEitherWayAndItsMiddleNotAtAll) {
  const auto cloud = threePoints({});
  const mrpt::math::TPose2D motion(0.4, 0, 0);
  expectPoints(scanInBaseWithThings(cloud, {kPi, true, motion}), {{-0.2F, -1}, {2, 0}, {0.2F, 1}});
  expectPoints(scanInBaseWithThings(cloud, {kPi, false, motion}), {{0.2F, -1}, {2, 0}, {-0.2F, 1}});
  // With an aperture of a full turn, these points are half the aperture from its ends: a quarter of the motion.
  expectPoints(scanInBaseWithThings(cloud, {2 * kPi, true, motion}), {{-0.1F, -1}, {2, 0}, {0.1F, 1}});
}

TEST(ScanInBase, ASweepOfAnUpsideDownSensorGoesTheOtherWayRound) {
  const auto cloud = threePoints({0, 0, 0.3, 0, 0, kPi});
  expectPoints(scanInBaseWithThings(cloud, {kPi, true, {0.4, 0, 0}}), {{-0.2F, 1}, {2, 0}, {0.2F, -1}});
}

}  // namespace
}  // namespace omnimapper::matching::scan_in_base_test
