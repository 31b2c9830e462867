#pragma once

#include <Eigen/Core>

namespace omnimapper::geometry {

/// Eigenvalues and eigenvectors of a symmetric matrix of n x n numbers; n is 2, 3, 6 or Eigen::Dynamic. They are
/// compiled here once for all libraries, because Eigen's solver takes the compiler seconds for each size
/// (doc/results/build.md).
template <int n>
struct SymmetricEigen {
  Eigen::Matrix<double, n, 1> values;   ///< ascending
  Eigen::Matrix<double, n, n> vectors;  ///< column i has length 1 and belongs to values[i]; its sign is arbitrary
};

/// Reads the lower triangle of `matrix`. All results are NaN if an entry is not finite.
template <int n>
SymmetricEigen<n> eigenOf(const Eigen::Matrix<double, n, n>& matrix);

/// The values of eigenOf() alone, ascending.
template <int n>
Eigen::Matrix<double, n, 1> eigenvaluesOf(const Eigen::Matrix<double, n, n>& matrix);

}  // namespace omnimapper::geometry
