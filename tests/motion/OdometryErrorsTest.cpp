#include <gtest/gtest.h>
#include <omnimapper/motion/OdometryErrors.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

namespace omnimapper::motion::odometry_errors_test {
namespace {

using mrpt::math::TPose2D;

// Drives 100 m with wheels whose distance has a random error of `per_root_m` [m / sqrt(m)].
OdometryErrors driven(double per_root_m) {
  testing::Dice dice(1);
  OdometryErrors errors;
  for (int i = 0; i < 2000; ++i) {
    errors.add({0.05 + dice.normal(per_root_m * std::sqrt(0.05)), dice.normal(per_root_m * std::sqrt(0.05)), 0},
               {0.05, 0, 0}, 1e-6, 1e-6);
  }
  return errors;
}

TEST(OdometryErrors, LearnsTheErrorThatAddsUp) {
  for (const double noise : {0.01, 0.05}) {
    const double sigma = std::sqrt(driven(noise).covarianceOf({1, 0, 0})(0, 0));
    EXPECT_GT(sigma, 0.6 * noise);
    EXPECT_LT(sigma, 1.6 * noise);
  }
}

// Stamps that are off by up to 0.1 s at 0.5 m/s: the errors are large from scan to scan and cancel over a metre.
TEST(OdometryErrors, ErrorsThatCancelCountFromScanToScan) {
  testing::Dice dice(2);
  OdometryErrors errors;
  double before = 0;
  for (int i = 0; i < 2000; ++i) {
    const double late = dice.normal(0.03);
    errors.add({0.05 + late - before, 0, 0}, {0.05, 0, 0}, 1e-6, 1e-6);
    before = late;
  }
  EXPECT_GT(std::sqrt(errors.covarianceOf({0.05, 0, 0})(0, 0)), 0.015);
  EXPECT_LT(std::sqrt(errors.covarianceOf({0.05, 0, 0})(0, 0)), 0.06);
}

TEST(OdometryErrors, AnInterruptedSpanTeachesNothing) {
  OdometryErrors errors;
  const double before = errors.covarianceOf({1, 0, 0})(0, 0);
  for (int i = 0; i < 100; ++i) {
    errors.add({0.5, 0, 0}, {0.5, 0, 0}, 1, 1);
    errors.interrupt();
  }
  EXPECT_DOUBLE_EQ(errors.covarianceOf({1, 0, 0})(0, 0), before);
}

TEST(OdometryErrors, MotionsThatAreNotFiniteTeachNothing) {
  OdometryErrors errors;
  for (int i = 0; i < 100; ++i) errors.add({0.5, NAN, 0}, {0.5, 0, 0}, 1e-6, 1e-6);
  EXPECT_TRUE(errors.covarianceOf({1, 0, 0}).allFinite());
}

}  // namespace
}  // namespace omnimapper::motion::odometry_errors_test
