#include <gtest/gtest.h>
#include <omnimapper/plugin/LocalizationEstimate.h>

namespace omnimapper::mapper::fix_test {
namespace {

LocalizationEstimate fixWith(double ahead, double aside, double up, double yaw) {
  LocalizationEstimate fix;
  fix.map_from_base = mrpt::poses::CPose3D(3, 4, 0, yaw, 0, 0);
  fix.covariance = Eigen::Matrix<double, 6, 6>::Zero();
  fix.covariance->diagonal().head<3>() = Eigen::Vector3d(ahead * ahead, aside * aside, up * up);
  fix.joined = true;
  return fix;
}

TEST(LocalizationEstimate, ThePositionsCovarianceIsAlongTheMapsAxes) {
  const auto position = *fixWith(0.3, 0.1, 0.2, M_PI / 2).positionCovariance();  // ahead is the map's y
  EXPECT_NEAR(position(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(position(1, 1), 0.09, 1e-12);
  EXPECT_NEAR(position(2, 2), 0.04, 1e-12);
  EXPECT_NEAR(position(0, 1), 0, 1e-12);
}

TEST(LocalizationEstimate, IsLocatedIfJoinedAndKnownOnTheFloorInEveryDirection) {
  EXPECT_TRUE(fixWith(0.49, 0.1, 5, 1).located()) << "the height does not count";
  EXPECT_FALSE(fixWith(0.51, 0.1, 0, 1).located());
  EXPECT_FALSE(fixWith(0.1, 0.51, 0, 0.7).located());
  auto fix = fixWith(0.1, 0.1, 0.1, 0);
  fix.joined = false;
  EXPECT_FALSE(fix.located());
  fix.joined = true;
  fix.covariance.reset();
  EXPECT_FALSE(fix.located()) << "a direction is open";
}

}  // namespace
}  // namespace omnimapper::mapper::fix_test
