#include <gtest/gtest.h>
#include <omnimapper/geometry/TumLine.h>

namespace tum_line_test {
namespace {

using namespace omnimapper;

TEST(TumLine, isStampPositionAndQuaternionWithScalarLastAndNotNegative) {
  // A turn about z, its quaternion given with the other sign.
  geometry::Se3 pose;
  pose.translation = {1, -2.5, 1e-10};
  pose.rotation = Eigen::Quaterniond(-0.6, 0, 0, -0.8);
  const auto stamp = base::stampFromUnix(1e9) + base::durationFromSeconds(0.1234567);
  EXPECT_EQ(
      geometry::tumLine(stamp, pose),
      "1000000000.1234567 1.000000000 -2.500000000 0.000000000 0.000000000 0.000000000 0.800000000 0.600000000\n");
}

}  // namespace
}  // namespace tum_line_test
