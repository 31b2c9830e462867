#include <gtest/gtest.h>
#include <omnimapper/sim_world/PointingError.h>
#include <omnimapper/sim_world/Random.h>

#include <cmath>

namespace pointing_error_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;

// The ray is along x, the target 1 m ahead, 0.5 m to the right and 0.2 m below: the ray passes left of and above it.
TEST(PointingError, signsAreThoseOfTheThesis) {
  const auto error = sim::pointingErrorOf({1, 1, 1}, {2, 0, 0}, {2, 0.5, 0.8});
  EXPECT_NEAR(error.theta, -std::atan(0.5), 1e-12);
  EXPECT_NEAR(error.psi, std::atan(0.2), 1e-12);
}

TEST(PointingError, aDirectionWithAnErrorHasIt) {
  sim::Random random(1, {});
  for (int i = 0; i < 1000; ++i) {
    const Vector3d hand{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.5, 2)};
    const double azimuth = random.uniform(-M_PI, M_PI), elevation = random.uniform(-0.8, 0.8);
    const Vector3d target =
        hand + random.uniform(0.5, 4) * Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const sim::PointingError wanted{random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)};
    const Vector3d direction = sim::directionWithError(hand, target, wanted);
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    const auto error = sim::pointingErrorOf(hand, direction, target);
    EXPECT_NEAR(error.theta, wanted.theta, 1e-9);
    EXPECT_NEAR(error.psi, wanted.psi, 1e-9);
  }
}

}  // namespace
}  // namespace pointing_error_test
