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
  const SignBearingFactor factor(MeasuredDirection({0.5, 0, 1}, Vector3d::UnitX()));
  const auto left = at(factor, map_from_base, {0, 3.5, 1}).residual();
  EXPECT_NEAR(left[0], geometry::kPi / 4, 1e-12) << "one metre ahead, one to the left";
  EXPECT_NEAR(left[1], 0, 1e-12);
  const auto below = at(factor, map_from_base, {1, 4.5, 0}).residual();
  EXPECT_NEAR(below[0], 0, 1e-12);
  EXPECT_NEAR(below[1], std::atan2(1, 2), 1e-12) << "two metres ahead, one down";
  EXPECT_NEAR(at(factor, map_from_base, {1, 6.5, 1}).residual().norm(), 0, 1e-12);
}

TEST(SignBearingFactor, IsFiniteEverywhere) {
  const SignBearingFactor factor(MeasuredDirection({0, 0, 1}, Vector3d::UnitX()));
  for (const Vector3d& point : {Vector3d(0, 0, 1), Vector3d(-1, 0, 1), Vector3d(-1, 1e-9, 1), Vector3d(0, 0, 5)}) {
    EXPECT_TRUE(at(factor, Se3{}, point).residual().allFinite()) << point.transpose();
    for (const auto& jacobian : at(factor, Se3{}, point).jacobians())
      EXPECT_TRUE(jacobian.allFinite()) << point.transpose();
  }
}

TEST(SignBearingFactor, WhatIsBehindTheCameraIsHalfATurnOff) {
  const SignBearingFactor factor(MeasuredDirection({0, 0, 1}, Vector3d::UnitX()));
  EXPECT_NEAR(at(factor, Se3{}, {-1, 0, 1}).residual().norm(), geometry::kPi, 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {-1, 1e-6, 1}).residual().norm(), geometry::kPi, 1e-5);
}

TEST(SignBearingFactor, JacobiansMatchDifferences) {
  testing::Dice dice(1);
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  for (int i = 0; i < 100; ++i) {
    const Se3 base{geometry::expSo3({any(1), any(1), any(1)}), {any(5), any(5), any(5)}};
    const Vector3d camera(any(1), any(1), any(1)), direction = Vector3d(any(1), any(1), any(0.5)).normalized();
    const SignBearingFactor factor(MeasuredDirection(camera, direction));
    const double aside = i % 2 == 0 ? 3 : 1e-5;  // where the angle is small too
    const Vector3d seen = camera + dice.uniform(1, 8) * direction + Vector3d(any(aside), any(aside), any(aside));
    graph::expectJacobiansMatchDifferences(at(factor, base, base * seen), 1e-5);
  }
}

TEST(SignBearingFactor, IsReadAsItWasWritten) {
  const SignBearingFactor factor(MeasuredDirection({0.1, 0.2, 1.4}, Vector3d(1, 2, 0.5).normalized()));
  std::stringstream bytes;
  factor.write(bytes);
  graph::FactorRegistry registry;
  SignBearingFactor::addTo(registry);
  const auto again = registry.readFactor("sign_bearing", bytes);
  EXPECT_EQ(at(*again, Se3{}, {2, 1, 1}).residual(), at(factor, Se3{}, {2, 1, 1}).residual());
}

graph::Evaluation at(const PanTiltBearingFactor& factor, const Se3& map_from_base, const Vector3d& point,
                     const Eigen::Vector2d& offsets) {
  return {factor, {graph::se3(), graph::point3(), graph::panTilt()}, {graph::toValue(map_from_base), point, offsets}};
}

// The camera reports that it looks ahead, but its pan unit is turned by 45 degrees to the left.
TEST(PanTiltBearingFactor, ResidualAsWorkedByHand) {
  const PanTiltBearingFactor factor(MeasuredDirection({0, 0, 1}, Vector3d::UnitX()), Vector3d::UnitY());
  const double pan = geometry::kPi / 4;
  EXPECT_NEAR(at(factor, Se3{}, {2, 2, 1}, {pan, 0}).residual().norm(), 0, 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {2, 2, 1}, {0, 0}).residual()[0], pan, 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {2, 0, 0}, {0, std::atan2(1, 2)}).residual().norm(), 0, 1e-12) << "down";
}

TEST(PanTiltBearingFactor, TurnsAboutTheVerticalAndThenAboutThePannedAxis) {
  testing::Dice dice(2);
  for (int i = 0; i < 20; ++i) {
    const double pan = dice.uniform(-1, 1), tilt = dice.uniform(-0.3, 0.3);
    const Eigen::Vector2d offsets(dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1));
    const auto looksAlong = [](double p, double t) {
      return Vector3d(Eigen::AngleAxisd(p, Vector3d::UnitZ()) * Eigen::AngleAxisd(t, Vector3d::UnitY()) *
                      Vector3d(0.9, 0.3, 0.1).normalized());
    };
    const Vector3d axis(-std::sin(pan), std::cos(pan), 0);
    const Vector3d reported = looksAlong(pan, tilt), meant = looksAlong(pan + offsets[0], tilt + offsets[1]);
    EXPECT_LT((turnedBy(offsets, axis, reported) - meant).norm(), 1e-12);
    const PanTiltBearingFactor factor(MeasuredDirection({0.1, 0, 1}, reported), axis);
    EXPECT_LT(at(factor, Se3{}, Vector3d(0.1, 0, 1) + 3 * meant, offsets).residual().norm(), 1e-12);
  }
}

TEST(PanTiltBearingFactor, JacobiansMatchDifferences) {
  testing::Dice dice(3);
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  for (int i = 0; i < 100; ++i) {
    const Se3 base{geometry::expSo3({any(1), any(1), any(1)}), {any(5), any(5), any(5)}};
    const Vector3d camera(any(1), any(1), any(1)), direction = Vector3d(any(1), any(1), any(0.5)).normalized();
    const double turn = any(3);
    const PanTiltBearingFactor factor(MeasuredDirection(camera, direction), {std::cos(turn), std::sin(turn), 0});
    const Vector3d seen = camera + dice.uniform(1, 8) * direction + Vector3d(any(2), any(2), any(2));
    graph::expectJacobiansMatchDifferences(at(factor, base, base * seen, {any(0.2), any(0.2)}), 1e-5);
  }
}

TEST(SignRangeFactor, IsTheLogarithmOfHowFarItIsOff) {
  const SignRangeFactor factor({0, 0, 1}, 2);
  EXPECT_NEAR(at(factor, Se3{}, {2, 0, 1}).residual()[0], 0, 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {0, 4, 1}).residual()[0], std::log(2), 1e-12);
  EXPECT_NEAR(at(factor, Se3{}, {0, 2e9, 1}).residual()[0], std::log(1e9), 1e-6);
  EXPECT_LT(at(factor, Se3{}, {0, 0, 1}).residual()[0], -5) << "in the camera";
  EXPECT_TRUE(at(factor, Se3{}, {0, 0, 1}).jacobians()[1].allFinite());
}

TEST(SignRangeFactor, JacobiansMatchDifferences) {
  testing::Dice dice(4);
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  for (int i = 0; i < 100; ++i) {
    const Se3 base{geometry::expSo3({any(1), any(1), any(1)}), {any(5), any(5), any(5)}};
    const SignRangeFactor factor({any(1), any(1), any(1)}, dice.uniform(0.5, 5));
    graph::expectJacobiansMatchDifferences(at(factor, base, {any(8), any(8), any(8)}), 1e-5);
  }
}

TEST(PanTiltBearingFactor, AndRangesAreReadAsTheyWereWritten) {
  const PanTiltBearingFactor factor(MeasuredDirection({0.1, 0.2, 1.4}, Vector3d(1, 2, 0.5).normalized()),
                                    Vector3d::UnitY());
  const SignRangeFactor range({0.1, 0.2, 1.4}, 3);
  std::stringstream bytes;
  factor.write(bytes);
  range.write(bytes);
  graph::FactorRegistry registry;
  PanTiltBearingFactor::addTo(registry);
  SignRangeFactor::addTo(registry);
  const Eigen::Vector2d offsets(0.02, -0.01);
  const auto again = registry.readFactor("sign_bearing_pan_tilt", bytes);
  EXPECT_EQ(at(dynamic_cast<const PanTiltBearingFactor&>(*again), Se3{}, {2, 1, 1}, offsets).residual(),
            at(factor, Se3{}, {2, 1, 1}, offsets).residual());
  EXPECT_EQ(at(*registry.readFactor("sign_range", bytes), Se3{}, {2, 1, 1}).residual(),
            at(range, Se3{}, {2, 1, 1}).residual());
}

}  // namespace
}  // namespace omnimapper::plugins::sign_bearing_factor_test
