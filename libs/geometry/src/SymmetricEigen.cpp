#include "omnimapper/geometry/SymmetricEigen.h"

#include <Eigen/Eigenvalues>
#include <limits>

namespace omnimapper::geometry {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

template <int n>
SymmetricEigen<n> eigenOf(const Eigen::Matrix<double, n, n>& matrix) {
  SymmetricEigen<n> result{Eigen::Matrix<double, n, 1>::Constant(matrix.rows(), kUnknown),
                           Eigen::Matrix<double, n, n>::Constant(matrix.rows(), matrix.cols(), kUnknown)};
  if (matrix.rows() == 0 || !matrix.allFinite()) return result;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(matrix);
  if (solver.info() == Eigen::Success) result = {solver.eigenvalues(), solver.eigenvectors()};
  return result;
}

template <int n>
Eigen::Matrix<double, n, 1> eigenvaluesOf(const Eigen::Matrix<double, n, n>& matrix) {
  Eigen::Matrix<double, n, 1> values = Eigen::Matrix<double, n, 1>::Constant(matrix.rows(), kUnknown);
  if (matrix.rows() == 0 || !matrix.allFinite()) return values;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(matrix, Eigen::EigenvaluesOnly);
  if (solver.info() == Eigen::Success) values = solver.eigenvalues();
  return values;
}

template SymmetricEigen<2> eigenOf<2>(const Eigen::Matrix2d&);
template SymmetricEigen<3> eigenOf<3>(const Eigen::Matrix3d&);
template SymmetricEigen<6> eigenOf<6>(const Eigen::Matrix<double, 6, 6>&);
template SymmetricEigen<Eigen::Dynamic> eigenOf<Eigen::Dynamic>(const Eigen::MatrixXd&);
template Eigen::Vector2d eigenvaluesOf<2>(const Eigen::Matrix2d&);
template Eigen::Vector3d eigenvaluesOf<3>(const Eigen::Matrix3d&);
template Eigen::Matrix<double, 6, 1> eigenvaluesOf<6>(const Eigen::Matrix<double, 6, 6>&);
template Eigen::VectorXd eigenvaluesOf<Eigen::Dynamic>(const Eigen::MatrixXd&);

}  // namespace omnimapper::geometry
