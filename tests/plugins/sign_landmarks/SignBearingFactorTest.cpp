#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../../graph/Jacobians.h"
#include "sign_landmarks/SignBearingFactor.h"

namespace omnimapper::plugins::sign_bearing_factor_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;

graph::Evaluation at(const graph::Factor& factor, const Se3& map_from_base, const Vector3d& point) {
  return {factor, {graph::se3(), graph::point3()}, {graph::toValue(map_from_base), point}};
}

// The numbers of doc/derivations/bearing.md: the base at (1, 2) looks along y, its camera is 0.5 m ahead, 1 m up.
TEST(SignBearingFactor, ResidualAsWorkedByHand) {
  const Se3 map_from_base{geometry::expSo3({0, 0, geometry::kPi / 2}), {1, 2, 0}};
  const SignBearingFactor factor({0.5, 0, 1}, Vector3d::UnitX());
  const auto left = at(factor, map_from_base, {0, 3.5, 1}).residual();
  EXPECT_NEAR(left[0], geometry::kPi / 4, 1e-12) << "one metre ahead, one to the left";
  EXPECT_NEAR(left[1], 0, 1e-12);
  const auto below = at(factor, map_from_base, {1, 4.5, 0}).residual();
  EXPECT_NEAR(below[0], 0, 1e-12);
  EXPECT_NEAR(below[1], std::atan2(1, 2), 1e-12) << "two metres ahead, one down";
  EXPECT_NEAR(at(factor, map_from_base, {1, 6.5, 1}).residual().norm(), 0, 1e-12);
}

TEST(SignBearingFactor, IsFiniteEverywhere) {
  const SignBearingFactor factor({0, 0, 1}, Vector3d::UnitX());
  for (const Vector3d& point : {Vector3d(0, 0, 1), Vector3d(-1, 0, 1), Vector3d(-1, 1e-9, 1), Vector3d(0, 0, 5)}) {
    EXPECT_TRUE(at(factor, Se3{}, point).residual().allFinite()) << point.transpose();
    for (const auto& jacobian : at(factor, Se3{}, point).jacobians())
      EXPECT_TRUE(jacobian.allFinite()) << point.transpose();
  }
}

TEST(SignBearingFactor, WhatIsBehindTheCameraIsHalfATurnOff) {
  const SignBearingFactor factor({0, 0, 1}, Vector3d::UnitX());
  EXPECT_NEAR(at(factor, Se3{}, {-1, 0, 1}).residual().norm(), geometry::kPi, 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {-1, 1e-6, 1}).residual().norm(), geometry::kPi, 1e-5);
}

TEST(SignBearingFactor, JacobiansMatchDifferences) {
  testing::Dice dice(1);
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  for (int i = 0; i < 100; ++i) {
    const Se3 base{geometry::expSo3({any(1), any(1), any(1)}), {any(5), any(5), any(5)}};
    const Vector3d camera(any(1), any(1), any(1)), direction = Vector3d(any(1), any(1), any(0.5)).normalized();
    const SignBearingFactor factor(camera, direction);
    const double aside = i % 2 == 0 ? 3 : 1e-5;  // where the angle is small too
    const Vector3d seen = camera + dice.uniform(1, 8) * direction + Vector3d(any(aside), any(aside), any(aside));
    graph::expectJacobiansMatchDifferences(at(factor, base, base * seen), 1e-5);
  }
}

TEST(SignBearingFactor, IsReadAsItWasWritten) {
  const SignBearingFactor factor({0.1, 0.2, 1.4}, Vector3d(1, 2, 0.5).normalized());
  std::stringstream bytes;
  factor.write(bytes);
  graph::FactorRegistry registry;
  SignBearingFactor::addTo(registry);
  const auto again = registry.readFactor("sign_bearing", bytes);
  EXPECT_EQ(at(*again, Se3{}, {2, 1, 1}).residual(), at(factor, Se3{}, {2, 1, 1}).residual());
}

}  // namespace
}  // namespace omnimapper::plugins::sign_bearing_factor_test
