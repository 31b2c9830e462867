#include <gtest/gtest.h>

#include <limits>

#include "omnimapper/geometry/SymmetricEigen.h"

namespace omnimapper::geometry::symmetric_eigen_test {
namespace {

TEST(SymmetricEigen, ValuesAscendAndVectorsBelongToThem) {
  // (1, 1) and (1, -1) are eigenvectors of this matrix, with the values 5 and -1.
  const Eigen::Matrix2d matrix{{2, 3}, {3, 2}};
  const auto eigen = eigenOf<2>(matrix);
  EXPECT_NEAR(eigen.values[0], -1, 1e-15);
  EXPECT_NEAR(eigen.values[1], 5, 1e-15);
  EXPECT_NEAR(eigen.vectors(0, 1), eigen.vectors(1, 1), 1e-15);
  EXPECT_NEAR(eigen.vectors(0, 0), -eigen.vectors(1, 0), 1e-15);
  EXPECT_NEAR(eigen.vectors.col(0).norm(), 1, 1e-15);
}

TEST(SymmetricEigen, ReadsTheLowerTriangle) {
  const Eigen::Matrix2d matrix{{2, 99}, {3, 2}};
  EXPECT_NEAR(eigenvaluesOf<2>(matrix)[1], 5, 1e-15);
}

template <int n>
void expectProductOfItsParts(int size) {
  const Eigen::Matrix<double, n, n> any = Eigen::Matrix<double, n, n>::NullaryExpr(
      size, size, [](Eigen::Index i, Eigen::Index j) { return 1.0 / static_cast<double>(1 + i + j); });
  const auto eigen = eigenOf<n>(any);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - any).norm(), 1e-14);
  EXPECT_LT((eigenvaluesOf<n>(any) - eigen.values).norm(), 1e-14);
}

TEST(SymmetricEigen, AMatrixIsTheProductOfItsPartsInEachSize) {
  expectProductOfItsParts<2>(2);
  expectProductOfItsParts<3>(3);
  expectProductOfItsParts<6>(6);
  expectProductOfItsParts<Eigen::Dynamic>(5);
}

TEST(SymmetricEigen, WhatIsNotFiniteHasNoValues) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(eigenvaluesOf<3>(matrix).array().isNaN().all());
  EXPECT_TRUE(eigenOf<3>(matrix).vectors.array().isNaN().all());
  matrix(1, 0) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(eigenvaluesOf<3>(matrix).array().isNaN().all());
}

TEST(SymmetricEigen, AnEmptyMatrixHasNone) {
  EXPECT_EQ(eigenvaluesOf<Eigen::Dynamic>(Eigen::MatrixXd(0, 0)).size(), 0);
}

}  // namespace
}  // namespace omnimapper::geometry::symmetric_eigen_test
