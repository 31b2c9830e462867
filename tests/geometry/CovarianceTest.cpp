#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "omnimapper/geometry/Covariance.h"

namespace omnimapper::geometry::covariance_test {
namespace {

template <int n>
Eigen::Matrix<double, n, n> randomCovariance(std::mt19937& rng, double sigma) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix<double, n, n> a = Eigen::Matrix<double, n, n>::NullaryExpr([&]() { return normal(rng); });
  return sigma * sigma * (a * a.transpose() + Eigen::Matrix<double, n, n>::Identity());
}

template <int n>
Eigen::Matrix<double, n, 1> draw(std::mt19937& rng, const Eigen::Matrix<double, n, n>& cov) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix<double, n, 1> unit = Eigen::Matrix<double, n, 1>::NullaryExpr([&]() { return normal(rng); });
  return cov.llt().matrixL() * unit;
}

/// Sample covariance of `error()` about zero.
template <int n, class Error>
Eigen::Matrix<double, n, n> sampleCovariance(const Error& error, int samples) {
  Eigen::Matrix<double, n, n> sum = Eigen::Matrix<double, n, n>::Zero();
  for (int i = 0; i < samples; ++i) {
    const Eigen::Matrix<double, n, 1> e = error();
    sum += e * e.transpose();
  }
  return sum / samples;
}

const Se2 kA2{2, -1, 0.8}, kB2{1, 3, -2.2};
const Se3 kA3{expSo3({0.4, -0.9, 1.1}), {2, -1, 0.5}}, kB3{expSo3({-1.2, 0.3, 0.6}), {1, 3, -2}};

TEST(Covariance, CompositionAndInverseMatchSamplesInThePlane) {
  std::mt19937 rng(1);
  const auto ca = randomCovariance<3>(rng, 1e-3), cb = randomCovariance<3>(rng, 2e-3);
  const auto composed = sampleCovariance<3>(
      [&] { return minus(plus(kA2, draw<3>(rng, ca)) * plus(kB2, draw<3>(rng, cb)), kA2 * kB2); }, 50000);
  const Eigen::Matrix3d expected = composeCovariance(ca, kB2, cb);
  EXPECT_LT((composed - expected).norm(), 0.03 * expected.norm());
  const auto inverted =
      sampleCovariance<3>([&] { return minus(inverse(plus(kA2, draw<3>(rng, ca))), inverse(kA2)); }, 50000);
  EXPECT_LT((inverted - inverseCovariance(kA2, ca)).norm(), 0.03 * inverted.norm());
}

TEST(Covariance, CompositionAndInverseMatchSamplesInSpace) {
  std::mt19937 rng(2);
  const auto ca = randomCovariance<6>(rng, 1e-3), cb = randomCovariance<6>(rng, 2e-3);
  const auto composed = sampleCovariance<6>(
      [&] { return minus(plus(kA3, draw<6>(rng, ca)) * plus(kB3, draw<6>(rng, cb)), kA3 * kB3); }, 50000);
  const Matrix6d expected = composeCovariance(ca, kB3, cb);
  EXPECT_LT((composed - expected).norm(), 0.03 * expected.norm());
  const auto inverted =
      sampleCovariance<6>([&] { return minus(inverse(plus(kA3, draw<6>(rng, ca))), inverse(kA3)); }, 50000);
  EXPECT_LT((inverted - inverseCovariance(kA3, ca)).norm(), 0.03 * inverted.norm());
}

TEST(Covariance, BetweenMatchesSamplesOfTheJoint) {
  std::mt19937 rng(3);
  const auto joint = randomCovariance<12>(rng, 1e-3);
  const Se3 a_from_b = inverse(kA3) * kB3;
  const auto sampled = sampleCovariance<6>(
      [&] {
        const auto d = draw<12>(rng, joint);
        return minus(inverse(plus(kA3, d.head<6>())) * plus(kB3, d.tail<6>()), a_from_b);
      },
      50000);
  EXPECT_LT((sampled - betweenCovariance(a_from_b, joint)).norm(), 0.03 * sampled.norm());

  const auto planar_joint = randomCovariance<6>(rng, 1e-3);
  const Se2 planar = inverse(kA2) * kB2;
  const auto planar_sampled = sampleCovariance<3>(
      [&] {
        const auto d = draw<6>(rng, planar_joint);
        return minus(inverse(plus(kA2, d.head<3>())) * plus(kB2, d.tail<3>()), planar);
      },
      50000);
  EXPECT_LT((planar_sampled - betweenCovariance(planar, planar_joint)).norm(), 0.03 * planar_sampled.norm());
}

TEST(Covariance, YawNoiseBecomesSidewaysNoiseAtADistance) {
  // 0.1 rad of yaw before 2 m of travel are 0.2 m to the side.
  const Eigen::Matrix3d yaw_only = Eigen::Vector3d(0, 0, 0.01).asDiagonal();
  const Eigen::Matrix3d far = composeCovariance(yaw_only, Se2{2, 0, 0}, Eigen::Matrix3d::Zero());
  Eigen::Matrix3d expected;
  expected << 0, 0, 0, 0, 0.04, 0.02, 0, 0.02, 0.01;
  EXPECT_LT((far - expected).norm(), 1e-15);
}

TEST(Covariance, CompositionIsAssociative) {
  std::mt19937 rng(4);
  const auto a = randomCovariance<6>(rng, 1), b = randomCovariance<6>(rng, 1), c = randomCovariance<6>(rng, 1);
  const Matrix6d left = composeCovariance(composeCovariance(a, kA3, b), kB3, c);
  const Matrix6d right = composeCovariance(a, kA3 * kB3, composeCovariance(b, kB3, c));
  EXPECT_LT((left - right).norm(), 1e-12 * left.norm());
}

TEST(Covariance, TransportInPlaneAndSpaceAgree) {
  std::mt19937 rng(5);
  const auto a = randomCovariance<3>(rng, 1), b = randomCovariance<3>(rng, 1);
  const Matrix6d in_space = composeCovariance(embedPlanar(a), lift(kB2), embedPlanar(b));
  EXPECT_LT((in_space - embedPlanar(composeCovariance(a, kB2, b))).norm(), 1e-12);
  EXPECT_EQ(planarPart(embedPlanar(a)), a);
}

}  // namespace
}  // namespace omnimapper::geometry::covariance_test
