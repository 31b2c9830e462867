#include <gtest/gtest.h>

#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "omnimapper/geometry/Se3.h"

namespace omnimapper::geometry::se3_test {
namespace {

Eigen::Vector3d randomVector(std::mt19937& rng, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(rng), uniform(rng), uniform(rng)};
}

Se3 randomSe3(std::mt19937& rng) {
  return {expSo3(randomVector(rng, 1.7)), randomVector(rng, 5)};
}

TEST(Angle, WrapsIntoTheHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrapToPi(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrapToPi(-kPi), kPi);
  EXPECT_NEAR(wrapToPi(3 * kPi), kPi, 1e-15);
  EXPECT_NEAR(wrapToPi(7), 7 - 2 * kPi, 1e-15);
  EXPECT_NEAR(wrapToPi(-7), 2 * kPi - 7, 1e-15);
  EXPECT_DOUBLE_EQ(wrapToPi(1.5), 1.5);
}

TEST(Rotation3, ExponentialIsTheMatrixExponentialOfSkew) {
  std::mt19937 rng(1);
  for (const double size : {1e-12, 1e-6, 9e-5, 1.1e-4, 1e-2, 1.0, 3.0}) {
    const Eigen::Vector3d w = size * randomVector(rng, 1).normalized();
    const Eigen::Matrix3d expected = skew(w).exp();
    EXPECT_LT((expSo3(w).toRotationMatrix() - expected).norm(), 1e-14) << size;
  }
}

TEST(Rotation3, LogarithmUndoesExponentialUpToHalfATurnAndForEitherSign) {
  std::mt19937 rng(2);
  for (const double size : {0.0, 1e-12, 1e-6, 1.9e-5, 2.1e-5, 1e-3, 1.0, 3.1, kPi - 1e-9}) {
    const Eigen::Vector3d w = size * randomVector(rng, 1).normalized();
    const Eigen::Quaterniond q = expSo3(w);
    EXPECT_LT((logSo3(q) - w).norm(), 1e-14 * (1 + size)) << size;
    EXPECT_LT((logSo3(Eigen::Quaterniond(-q.coeffs())) - w).norm(), 1e-14 * (1 + size)) << size;
  }
}

TEST(Rotation3, InverseRightJacobianIsTheDerivativeOfTheLogarithm) {
  std::mt19937 rng(3);
  const double h = 1e-6;
  for (const double size : {0.0, 1e-4, 3e-3, 3.3e-3, 0.5, 2.0, kPi}) {
    const Eigen::Vector3d w = size * randomVector(rng, 1).normalized();
    Eigen::Matrix3d exp_derivative, log_derivative;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
      exp_derivative.col(i) = logSo3(expSo3(w - step).conjugate() * expSo3(w + step)) / (2 * h);
      // Beyond half a turn the logarithm is the shorter rotation, so its derivative is tested below that.
      if (size < 3)
        log_derivative.col(i) = (logSo3(expSo3(w) * expSo3(step)) - logSo3(expSo3(w) * expSo3(-step))) / (2 * h);
    }
    if (size < 3) {
      EXPECT_LT((inverseRightJacobianSo3(w) - log_derivative).norm(), 1e-8) << size;
    }
    EXPECT_LT((exp_derivative * inverseRightJacobianSo3(w) - Eigen::Matrix3d::Identity()).norm(), 1e-8) << size;
  }
}

TEST(Se2, HandWorkedMotion) {
  const Se2 map_from_base{1, 2, kPi / 2};
  const Se2 base_from_sensor{3, 0, kPi / 2};
  const Se2 map_from_sensor = map_from_base * base_from_sensor;
  EXPECT_NEAR(map_from_sensor.x, 1, 1e-15);
  EXPECT_NEAR(map_from_sensor.y, 5, 1e-15);
  EXPECT_NEAR(map_from_sensor.yaw, kPi, 1e-15);
  EXPECT_LT((map_from_base * Eigen::Vector2d(1, 1) - Eigen::Vector2d(0, 3)).norm(), 1e-15);
  EXPECT_LT((minus(map_from_sensor, map_from_base) - Eigen::Vector3d(3, 0, kPi / 2)).norm(), 1e-15);
}

TEST(Se2, InversePlusAndMinusAreConsistent) {
  std::mt19937 rng(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d v = randomVector(rng, 3), d = randomVector(rng, 3);
    const Se2 a{v[0], v[1], v[2]};
    EXPECT_LT(minus(a * inverse(a), Se2{}).norm(), 1e-14);
    EXPECT_LT(minus(inverse(a) * a, Se2{}).norm(), 1e-14);
    EXPECT_LT((minus(plus(a, d), a) - d).norm(), 1e-14);
  }
}

TEST(Se2, AdjointMovesATangentAcrossAPose) {
  const Se2 a{1.5, -0.7, 2.1};
  const Eigen::Vector3d d(1e-6, -2e-6, 3e-6);
  EXPECT_LT(minus(a * plus(Se2{}, d), plus(Se2{}, adjoint(a) * d) * a).norm(), 1e-11);
}

TEST(Se3, HandWorkedMotion) {
  const Se3 map_from_base{Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {1, 2, 3}};  // 90 deg about z
  EXPECT_LT((map_from_base * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-15);
  EXPECT_LT((inverse(map_from_base) * Eigen::Vector3d(1, 3, 3) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  Vector6d d;
  d << 1, 0, 0, 0, 0, kPi / 2;
  const Se3 moved = plus(map_from_base, d);
  EXPECT_LT((moved.translation - Eigen::Vector3d(1, 3, 3)).norm(), 1e-15);
  EXPECT_NEAR(project(moved).yaw, kPi, 1e-15);
}

TEST(Se3, InversePlusAndMinusAreConsistent) {
  std::mt19937 rng(5);
  for (int i = 0; i < 100; ++i) {
    const Se3 a = randomSe3(rng);
    Vector6d d;
    d << randomVector(rng, 3), randomVector(rng, 1.7);
    EXPECT_LT(minus(a * inverse(a), Se3{}).norm(), 1e-14);
    EXPECT_LT(minus(inverse(a) * a, Se3{}).norm(), 1e-14);
    EXPECT_LT((minus(plus(a, d), a) - d).norm(), 2e-14);
  }
}

TEST(Se3, CompositionIsThatOfHomogeneousMatrices) {
  std::mt19937 rng(6);
  const Se3 a = randomSe3(rng), b = randomSe3(rng);
  const auto matrix = [](const Se3& pose) {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
    m.topRightCorner<3, 1>() = pose.translation;
    return m;
  };
  EXPECT_LT((matrix(a * b) - matrix(a) * matrix(b)).norm(), 1e-13);
}

TEST(Se3, AdjointMovesATangentAcrossAPose) {
  std::mt19937 rng(7);
  const Se3 a = randomSe3(rng);
  Vector6d d;
  d << 1e-6, -2e-6, 3e-6, 2e-6, 1e-6, -1e-6;
  const Vector6d moved = adjoint(a) * d;
  EXPECT_LT(minus(a * plus(Se3{}, d), plus(Se3{}, moved) * a).norm(), 1e-10);
}

TEST(Se3, LiftKeepsPlanarMotionsAndTheirTangent) {
  const Se2 a{1, -2, 2.5}, b{0.5, 3, -1.2};
  EXPECT_LT(minus(lift(a) * lift(b), lift(a * b)).norm(), 1e-14);
  EXPECT_LT(minus(project(lift(a)), a).norm(), 1e-15);
  const Vector6d d = minus(lift(b), lift(a));
  EXPECT_LT((Eigen::Vector3d(d[0], d[1], d[5]) - minus(b, a)).norm(), 1e-14);
  EXPECT_LT((Eigen::Vector3d(d[2], d[3], d[4])).norm(), 1e-15);
}

}  // namespace
}  // namespace omnimapper::geometry::se3_test
