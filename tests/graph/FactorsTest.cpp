#include <gtest/gtest.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include <sstream>

#include "Jacobians.h"
#include "Worlds.h"
#include "omnimapper/graph/FactorRegistry.h"

namespace omnimapper::graph::factors_test {
namespace {

const double kHalf = std::sqrt(0.5);

Eigen::VectorXd vector(std::initializer_list<double> numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.begin(), static_cast<Eigen::Index>(numbers.size()));
}

TEST(BetweenSe2, HandWorkedResidual) {
  // a at (1, 2) facing +y, b at (1, 5) facing -x: b stands 3 m ahead of a, turned by 90 deg. Measured: 2 m ahead,
  // turned by 90 deg. In the measured frame b, which faces a's left, 1 m ahead of a is 1 m to the right: y = -1.
  const BetweenSe2 factor({2, 0, geometry::kPi / 2});
  const Evaluation at{factor, {se2(), se2()}, {vector({1, 2, geometry::kPi / 2}), vector({1, 5, geometry::kPi})}};
  EXPECT_LT((at.residual() - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
}

TEST(BetweenSe2, ResidualIsMinusOfPredictedAndMeasured) {
  Noise noise(2);
  for (int i = 0; i < 20; ++i) {
    const Se2 measured = noise.se2(), a = noise.se2(), b = noise.se2();
    const BetweenSe2 factor(measured);
    const Evaluation at{factor, {se2(), se2()}, {toValue(a), toValue(b)}};
    EXPECT_LT((at.residual() - geometry::minus(inverse(a) * b, measured)).norm(), 1e-13);
  }
}

TEST(BetweenSe3, HandWorkedResidual) {
  // a at (1, 2, 3) turned by 90 deg about z, b 2 m above it and turned by 90 deg about z once more; measured: no
  // motion.
  const BetweenSe3 factor(Se3{});
  const Evaluation at{factor, {se3(), se3()}, {vector({1, 2, 3, 0, 0, kHalf, kHalf}), vector({1, 2, 5, 0, 0, 1, 0})}};
  EXPECT_LT((at.residual() - vector({0, 0, 2, 0, 0, geometry::kPi / 2})).norm(), 1e-15);
}

TEST(BetweenSe3, ResidualIsMinusOfPredictedAndMeasured) {
  Noise noise(3);
  for (int i = 0; i < 20; ++i) {
    const Se3 measured = noise.se3(), a = noise.se3(), b = noise.se3();
    const BetweenSe3 factor(measured);
    const Evaluation at{factor, {se3(), se3()}, {toValue(a), toValue(b)}};
    EXPECT_LT((at.residual() - geometry::minus(inverse(a) * b, measured)).norm(), 1e-13);
  }
}

TEST(PriorSe2, HandWorkedResidual) {
  const PriorSe2 factor({1, 1, geometry::kPi / 2});
  const Evaluation at{factor, {se2()}, {vector({1, 3, geometry::kPi})}};
  EXPECT_LT((at.residual() - Eigen::Vector3d(2, 0, geometry::kPi / 2)).norm(), 1e-15);
}

TEST(PriorSe3, HandWorkedResidual) {
  const PriorSe3 factor({Eigen::Quaterniond(kHalf, 0, 0, kHalf), {1, 1, 0}});
  const Evaluation at{factor, {se3()}, {vector({1, 3, 0, 0, 0, 1, 0})}};
  EXPECT_LT((at.residual() - vector({2, 0, 0, 0, 0, geometry::kPi / 2})).norm(), 1e-15);
}

TEST(PointFactor2, HandWorkedResidual) {
  const PointFactor2 factor({2, 0.5});
  const Evaluation at{factor, {se2(), point2()}, {vector({1, 1, geometry::kPi / 2}), vector({0, 4})}};
  EXPECT_LT((at.residual() - Eigen::Vector2d(1, 0.5)).norm(), 1e-15);
}

TEST(PointFactor3, HandWorkedResidual) {
  const PointFactor3 factor({2, 0.5, 1});
  const Evaluation at{factor, {se3(), point3()}, {vector({1, 1, 1, 0, 0, kHalf, kHalf}), vector({0, 4, 3})}};
  EXPECT_LT((at.residual() - Eigen::Vector3d(1, 0.5, 1)).norm(), 1e-15);
}

TEST(Factors, JacobiansMatchFiniteDifferences) {
  Noise noise(4);
  for (int i = 0; i < 10; ++i) {
    const Se2 planar = noise.se2();
    const Se3 spatial = noise.se3();
    const Eigen::VectorXd pose2 = toValue(noise.se2()), pose3 = toValue(noise.se3());
    expectJacobiansMatchDifferences({BetweenSe2(planar), {se2(), se2()}, {pose2, toValue(noise.se2())}});
    expectJacobiansMatchDifferences({PriorSe2(planar), {se2()}, {pose2}});
    expectJacobiansMatchDifferences(
        {PointFactor2(noise.vector(3).head<2>()), {se2(), point2()}, {pose2, noise.vector(3).head<2>()}});
    expectJacobiansMatchDifferences({PointFactor3(noise.vector(3)), {se3(), point3()}, {pose3, noise.vector(3)}});
    // A rotation error beyond half a turn wraps, so it is kept below.
    const Se3 moved = plus(spatial, (geometry::Vector6d() << noise.vector(3), noise.vector(1.5)).finished());
    expectJacobiansMatchDifferences({PriorSe3(spatial), {se3()}, {toValue(moved)}});
    const Se3 a = noise.se3();
    expectJacobiansMatchDifferences({BetweenSe3(spatial), {se3(), se3()}, {toValue(a), toValue(a * moved)}});
  }
}

TEST(Factors, JacobiansMatchAtAndNearZeroResidual) {
  Noise noise(5);
  for (const double size : {0.0, 1e-9, 1e-5, 1e-3}) {
    const Se3 a = noise.se3(), a_from_b = noise.se3();
    const Se3 b = a * plus(a_from_b, geometry::Vector6d::Constant(size));
    expectJacobiansMatchDifferences({BetweenSe3(a_from_b), {se3(), se3()}, {toValue(a), toValue(b)}});
  }
}

TEST(Factors, OnlyTheJacobiansAskedForAreWritten) {
  Noise noise(6);
  const BetweenSe3 factor(noise.se3());
  const Evaluation at{factor, {se3(), se3()}, {toValue(noise.se3()), toValue(noise.se3())}};
  const std::vector<RowMatrix> both = at.jacobians();
  RowMatrix second(6, 6);
  Eigen::VectorXd residual(6);
  const double* values[] = {at.values[0].data(), at.values[1].data()};
  double* jacobians[] = {nullptr, second.data()};
  factor.evaluate(values, residual.data(), jacobians);
  EXPECT_EQ(second, both[1]);
}

// A map of 10 m x 4 m x 2 m.
TEST(Factors, OutlierVolumeIsThatOfAllMeasurementsThatRelateTwoPlacesOfTheMap) {
  const Eigen::Vector3d size(10, 4, 2);
  const double pi = geometry::kPi;
  EXPECT_DOUBLE_EQ(BetweenSe2({}).outlierVolume(size).value(), 40 * 2 * pi);       // [m^2 rad]
  EXPECT_DOUBLE_EQ(BetweenSe3({}).outlierVolume(size).value(), 80 * 8 * pi * pi);  // [m^3 rad^3]
  EXPECT_DOUBLE_EQ(SamePointFactor().outlierVolume(size).value(), 80);             // [m^3]
  EXPECT_DOUBLE_EQ(SamePointFactor(0.25).outlierVolume(size).value(), 20);
  EXPECT_FALSE(PriorSe2({}).outlierVolume(size));
}

TEST(Factors, ReadBackByTheRegistryTheyMeasureTheSame) {
  Noise noise(7);
  const Se2 planar = noise.se2();
  const Se3 spatial = noise.se3();
  const std::vector<std::shared_ptr<const Factor>> factors = {std::make_shared<BetweenSe2>(planar),
                                                              std::make_shared<BetweenSe3>(spatial),
                                                              std::make_shared<PriorSe2>(planar),
                                                              std::make_shared<PriorSe3>(spatial),
                                                              std::make_shared<PointFactor2>(Eigen::Vector2d(1, 2)),
                                                              std::make_shared<PointFactor3>(Eigen::Vector3d(1, 2, 3))};
  const FactorRegistry registry = FactorRegistry::withBuiltIns();
  for (const auto& factor : factors) {
    std::stringstream bytes;
    factor->write(bytes);
    const auto back = registry.readFactor(std::string(factor->kind()), bytes);
    EXPECT_EQ(back->kind(), factor->kind());
    std::stringstream again;
    back->write(again);
    EXPECT_EQ(again.str(), bytes.str());
  }
}

}  // namespace
}  // namespace omnimapper::graph::factors_test
