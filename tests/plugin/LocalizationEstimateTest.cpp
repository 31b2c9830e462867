#include <gtest/gtest.h>
#include <omnimapper/plugin/LocalizationEstimate.h>

namespace omnimapper::mapper::fix_test {
namespace {

LocalizationEstimate estimateWith(double ahead, double aside, double up, double yaw) {
  LocalizationEstimate estimate;
  estimate.map_from_base = mrpt::poses::CPose3D(3, 4, 0, yaw, 0, 0);
  estimate.covariance = Eigen::Matrix<double, 6, 6>::Zero();
  estimate.covariance->diagonal().head<3>() = Eigen::Vector3d(ahead * ahead, aside * aside, up * up);
  estimate.aligned = true;
  return estimate;
}

TEST(LocalizationEstimate, ThePositionsCovarianceIsAlongTheMapsAxes) {
  const auto position = *estimateWith(0.3, 0.1, 0.2, M_PI / 2).positionCovariance();  // ahead is the map's y
  EXPECT_NEAR(position(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(position(1, 1), 0.09, 1e-12);
  EXPECT_NEAR(position(2, 2), 0.04, 1e-12);
  EXPECT_NEAR(position(0, 1), 0, 1e-12);
}

TEST(LocalizationEstimate, IsLocatedIfAlignedAndKnownOnTheFloorInEveryDirection) {
  EXPECT_TRUE(estimateWith(0.49, 0.1, 5, 1).located()) << "the height does not count";
  EXPECT_FALSE(estimateWith(0.51, 0.1, 0, 1).located());
  EXPECT_FALSE(estimateWith(0.1, 0.51, 0, 0.7).located());
  auto estimate = estimateWith(0.1, 0.1, 0.1, 0);
  estimate.aligned = false;
  EXPECT_FALSE(estimate.located());
  estimate.aligned = true;
  estimate.covariance.reset();
  EXPECT_FALSE(estimate.located()) << "a direction is open";
}

}  // namespace
}  // namespace omnimapper::mapper::fix_test
