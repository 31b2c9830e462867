#pragma once

#include <Eigen/Core>

namespace omnimapper::graph {

/// How much a residual is trusted: a square matrix W with W^T W = information = covariance^-1. W * residual is the
/// whitened residual, whose unit is one standard deviation. W is always valid, and has the size of the residual.
class SquareRootInformation {
 public:
  /// Each throws Error(internal) if the matrix is not square, not symmetric, not positive definite or not finite.
  static SquareRootInformation fromCovariance(const Eigen::MatrixXd& covariance);
  static SquareRootInformation fromInformation(const Eigen::MatrixXd& information);
  /// Standard deviations, in the unit of each row.
  static SquareRootInformation fromSigmas(const Eigen::VectorXd& sigmas);
  /// Takes W itself, as matrix() returns it. Throws Error(internal) if W is not square, not finite or singular.
  static SquareRootInformation fromMatrix(const Eigen::MatrixXd& matrix);
  /// The standard deviation of every row is 1.
  static SquareRootInformation identity(int size);

  int size() const { return static_cast<int>(matrix_.rows()); }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  Eigen::MatrixXd information() const { return matrix_.transpose() * matrix_; }
  Eigen::MatrixXd covariance() const;

 private:
  explicit SquareRootInformation(Eigen::MatrixXd matrix) : matrix_(std::move(matrix)) {}
  Eigen::MatrixXd matrix_;
};

}  // namespace omnimapper::graph
