#include <gtest/gtest.h>
#include <omnimapper/interaction/PointingError.h>

#include <cmath>
#include <random>

namespace omnimapper::interaction::pointing_error_test {
namespace {

using Eigen::Vector3d;

// The ray is along x, the target 1 m ahead, 0.5 m to the right and 0.2 m below: the ray passes left of and above it.
TEST(PointingError, signsAreThoseOfTheThesis) {
  const auto error = pointingErrorOf({1, 1, 1}, {2, 0, 0}, {2, 0.5, 0.8});
  EXPECT_NEAR(error.theta, -std::atan(0.5), 1e-12);
  EXPECT_NEAR(error.psi, std::atan(0.2), 1e-12);
}

TEST(PointingError, aDirectionWithAnErrorHasIt) {
  std::mt19937_64 random(1);
  const auto drawn = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 1000; ++i) {
    const Vector3d hand{drawn(-1, 1), drawn(-1, 1), drawn(0.5, 2)};
    const double azimuth = drawn(-M_PI, M_PI), elevation = drawn(-0.8, 0.8);
    const Vector3d target =
        hand + drawn(0.5, 4) * Vector3d(std::cos(elevation) * std::cos(azimuth),
                                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const PointingError wanted{drawn(-0.6, 0.6), drawn(-0.6, 0.6)};
    const Vector3d direction = directionWithError(hand, target, wanted);
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    const auto error = pointingErrorOf(hand, direction, target);
    EXPECT_NEAR(error.theta, wanted.theta, 1e-9);
    EXPECT_NEAR(error.psi, wanted.psi, 1e-9);
  }
}

}  // namespace
}  // namespace omnimapper::interaction::pointing_error_test
