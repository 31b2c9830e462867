#include <gtest/gtest.h>
#include <omnimapper/matching/PointToLineMatcher.h>

#include <Eigen/LU>

#include "Scans.h"

namespace omnimapper::matching::match_covariance_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;

// Mean of the squared errors over the reported covariance; 3 if that is right.
double meanSquaredError(double sigma) {
  const PointToLineMatcher matcher(ScanMatcherOptions{});
  const auto plan = FloorPlan::ring();
  double sum = 0;
  int count = 0;
  for (const TPose2D pose : {TPose2D(0, 0, 0), TPose2D(8.4, 3, 1.66), TPose2D(-2, 9, -3.1), TPose2D(-8.3, 4, -1.57)}) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const TPose2D motion(0.3, -0.05, 0.1);
      const auto reference = scanFrom(plan, pose, sigma, 2 * seed),
                 scan = scanFrom(plan, pose + motion, sigma, 2 * seed + 1);
      const auto found = matcher.match(*matcher.prepare(reference), scan, motion + TPose2D(0.03, -0.04, 0.02));
      const auto difference = found.reference_from_scan - motion;
      const Eigen::Vector3d error(difference.x, difference.y, difference.phi);
      const Eigen::Matrix3d covariance = found.point_sigma * found.point_sigma * found.unit_covariance;
      sum += error.dot(covariance.inverse() * error);
      ++count;
    }
  }
  return sum / count;
}

TEST(MatchCovariance, IsHonestForSensorsOfAnyNoise) {
  for (const double sigma : {0.005, 0.01, 0.02, 0.05, 0.1, 0.2}) {
    const double ratio = meanSquaredError(sigma);
    EXPECT_GT(ratio, 0.8) << sigma;
    EXPECT_LT(ratio, 6) << sigma;
  }
}

}  // namespace
}  // namespace omnimapper::matching::match_covariance_test
