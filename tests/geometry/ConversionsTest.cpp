#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include <functional>
#include <random>

#include "omnimapper/geometry/Conversions.h"
#include "omnimapper/geometry/Covariance.h"

namespace omnimapper::geometry::conversions_test {
namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

template <int n>
Eigen::Matrix<double, n, n> randomCovariance(std::mt19937& rng) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix<double, n, n> a = Eigen::Matrix<double, n, n>::NullaryExpr([&]() { return normal(rng); });
  return a * a.transpose() + Eigen::Matrix<double, n, n>::Identity();
}

/// Derivative of f at zero by central differences.
template <int n>
Eigen::Matrix<double, n, n> derivative(
    const std::function<Eigen::Matrix<double, n, 1>(const Eigen::Matrix<double, n, 1>&)>& f) {
  const double h = 1e-6;
  Eigen::Matrix<double, n, n> jacobian;
  for (int i = 0; i < n; ++i) {
    const Eigen::Matrix<double, n, 1> step = h * Eigen::Matrix<double, n, 1>::Unit(i);
    jacobian.col(i) = (f(step) - f(-step)) / (2 * h);
  }
  return jacobian;
}

TEST(Conversions, PoseToMrptAndBackActsOnPointsAlike) {
  const CPose3D pose(1, -2, 3, 0.4, -0.5, 2.6);
  const Se3 ours = fromMrpt(pose);
  double x, y, z;
  pose.composePoint(0.3, 0.7, -1.1, x, y, z);
  EXPECT_LT((ours * Eigen::Vector3d(0.3, 0.7, -1.1) - Eigen::Vector3d(x, y, z)).norm(), 1e-14);
  EXPECT_LT(minus(fromMrpt(toMrpt(ours)), ours).norm(), 1e-14);
  EXPECT_NEAR(toMrpt(ours).yaw(), 0.4, 1e-14);
  EXPECT_NEAR(project(ours).yaw, 0.4, 1e-14);
}

TEST(Conversions, PlanarPoseToMrptAndBack) {
  const Se2 ours = fromMrpt(CPose2D(1, 2, 4));
  EXPECT_NEAR(ours.yaw, 4 - 2 * kPi, 1e-15);
  EXPECT_EQ(minus(fromMrpt(toMrpt(ours)), ours).norm(), 0);
}

TEST(Conversions, MrptCovarianceIsCarriedByTheDerivativeOfItsParameters) {
  std::mt19937 rng(1);
  for (const double pitch : {0.0, -0.6, 1.4}) {
    const CPose3D mean(1, -2, 3, 2.4, pitch, -1.1);
    const Matrix6d jacobian = derivative<6>([&](const Vector6d& d) {
      const CPose3D moved(mean.x() + d[0], mean.y() + d[1], mean.z() + d[2], mean.yaw() + d[3], mean.pitch() + d[4],
                          mean.roll() + d[5]);
      return minus(fromMrpt(moved), fromMrpt(mean));
    });
    const Matrix6d mrpt_cov = randomCovariance<6>(rng);
    const Matrix6d ours = covarianceFromMrpt(mean, mrpt_cov);
    EXPECT_LT((ours - jacobian * mrpt_cov * jacobian.transpose()).norm(), 1e-7 * ours.norm());
    EXPECT_LT((covarianceToMrpt(mean, ours) - mrpt_cov).norm(), 1e-10 * mrpt_cov.norm());
  }
}

TEST(Conversions, MrptComposesCovariancesAsWeDo) {
  std::mt19937 rng(2);
  mrpt::poses::CPose3DPDFGaussian a, b;
  a.mean = CPose3D(1, 2, 3, 0.3, -0.4, 0.5);
  b.mean = CPose3D(-2, 1, 0.5, -1.3, 0.4, 0.2);
  a.cov = mrpt::math::CMatrixDouble66(Matrix6d(1e-4 * randomCovariance<6>(rng)));
  b.cov = mrpt::math::CMatrixDouble66(Matrix6d(1e-4 * randomCovariance<6>(rng)));
  const GaussianSe3 first = fromMrpt(a), second = fromMrpt(b);
  a += b;
  const GaussianSe3 by_mrpt = fromMrpt(a);
  const Matrix6d expected = composeCovariance(first.cov, second.mean, second.cov);
  EXPECT_LT(minus(by_mrpt.mean, first.mean * second.mean).norm(), 1e-12);
  EXPECT_LT((by_mrpt.cov - expected).norm(), 1e-6 * expected.norm());
}

TEST(Conversions, GaussiansSurviveTheRoundTrip) {
  std::mt19937 rng(3);
  const GaussianSe3 in_space{{expSo3({0.3, -0.8, 1.2}), {1, 2, 3}}, randomCovariance<6>(rng)};
  const GaussianSe3 space_back = fromMrpt(toMrpt(in_space));
  EXPECT_LT(minus(space_back.mean, in_space.mean).norm(), 1e-14);
  EXPECT_LT((space_back.cov - in_space.cov).norm(), 1e-11);
  const GaussianSe2 in_plane{{1, 2, -2}, randomCovariance<3>(rng)};
  const GaussianSe2 plane_back = fromMrpt(toMrpt(in_plane));
  EXPECT_LT(minus(plane_back.mean, in_plane.mean).norm(), 1e-14);
  EXPECT_LT((plane_back.cov - in_plane.cov).norm(), 1e-12);
}

TEST(Conversions, PlanarMrptCovarianceTurnsIntoTheBaseFrame) {
  // Facing +y, noise along the map's x is noise to the side of the base.
  const Eigen::Matrix3d mrpt_cov = Eigen::Vector3d(4, 1, 0.5).asDiagonal();
  const Eigen::Matrix3d ours = covarianceFromMrpt(CPose2D(7, 8, kPi / 2), mrpt_cov);
  const Eigen::Matrix3d expected = Eigen::Vector3d(1, 4, 0.5).asDiagonal();
  EXPECT_LT((ours - expected).norm(), 1e-15);
}

TEST(Conversions, NoMrptCovarianceAtGimbalLock) {
  const CPose3D up(0, 0, 0, 0.1, kPi / 2, 0);
  EXPECT_THROW(covarianceToMrpt(up, Matrix6d::Identity()), base::Error);
  EXPECT_TRUE(covarianceFromMrpt(up, Matrix6d::Identity()).allFinite());
}

TEST(Conversions, G2oInformationGivesTheSameChi2ForSmallErrors) {
  std::mt19937 rng(4);
  const Matrix6d g2o = randomCovariance<6>(rng);
  Vector6d tangent;
  tangent << 1e-4, -2e-4, 3e-4, 2e-4, 1e-4, -3e-4;
  Vector6d g2o_error = tangent;
  g2o_error.tail<3>() = expSo3(tangent.tail<3>()).vec();
  const double expected = g2o_error.dot(g2o * g2o_error);
  EXPECT_NEAR(tangent.dot(informationFromG2o(g2o) * tangent), expected, 1e-6 * expected);
  EXPECT_LT((informationToG2o(informationFromG2o(g2o)) - g2o).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(informationFromG2o(Matrix6d::Identity())(5, 5), 0.25);
  EXPECT_DOUBLE_EQ(informationFromG2o(Matrix6d::Identity())(0, 0), 1);
}

}  // namespace
}  // namespace omnimapper::geometry::conversions_test
