#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include <Eigen/LU>
#include <cmath>

#include "omnimapper/graph/Noise.h"

namespace omnimapper::graph::noise_test {
namespace {

Eigen::Matrix2d matrix(double a, double b, double c, double d) {
  Eigen::Matrix2d m;
  m << a, b, c, d;
  return m;
}

TEST(SquareRootInformation, WhitensByOneOverSigma) {
  const auto noise = SquareRootInformation::fromSigmas(Eigen::Vector2d(0.5, 0.1));
  EXPECT_LT((noise.matrix() * Eigen::Vector2d(1, 1) - Eigen::Vector2d(2, 10)).norm(), 1e-15);
}

TEST(SquareRootInformation, CovarianceAndInformationSaySame) {
  const Eigen::Matrix2d covariance = matrix(4, 1, 1, 2);
  const auto noise = SquareRootInformation::fromCovariance(covariance);
  EXPECT_LT((noise.information() - covariance.inverse()).norm(), 1e-15);
  EXPECT_LT((noise.covariance() - covariance).norm(), 1e-14);
  const auto same = SquareRootInformation::fromInformation(covariance.inverse());
  EXPECT_LT((same.information() - noise.information()).norm(), 1e-15);
  // Mahalanobis distance of (1, 1): [1 1] inverse(covariance) [1 1]^T = (2 - 2 + 4) / 7.
  EXPECT_NEAR((noise.matrix() * Eigen::Vector2d(1, 1)).squaredNorm(), 4.0 / 7, 1e-15);
}

TEST(SquareRootInformation, RefusesWhatIsNoCovariance) {
  const double nan = std::nan("");
  EXPECT_THROW(SquareRootInformation::fromCovariance(matrix(1, 2, 2, 1)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromCovariance(matrix(1, 0, 0, 0)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromCovariance(matrix(1, 0.5, 0, 1)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromCovariance(matrix(nan, 0, 0, 1)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromCovariance(Eigen::MatrixXd(2, 3)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromCovariance(Eigen::MatrixXd()), base::Error);
  EXPECT_THROW(SquareRootInformation::fromInformation(matrix(1, 0, 0, -1)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromSigmas(Eigen::Vector2d(1, 0)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromSigmas(Eigen::Vector2d(1, -1)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromSigmas(Eigen::Vector2d(1, nan)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromSigmas(Eigen::Vector2d(1, 1e-320)), base::Error);
  EXPECT_THROW(SquareRootInformation::fromMatrix(matrix(1, 1, 1, 1)), base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::noise_test
