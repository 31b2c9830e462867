#include "omnimapper/graph/Noise.h"

#include <omnimapper/base/Error.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <sstream>

namespace omnimapper::graph {

namespace {

[[noreturn]] void fail(const std::string& what, const Eigen::MatrixXd& matrix, const std::string& remedy) {
  std::ostringstream text;
  text << what << ' ' << remedy << "; the matrix is\n" << matrix;
  throw base::Error(base::ExitCode::internal, text.str());
}

void checkSquareAndFinite(const Eigen::MatrixXd& matrix, const std::string& what) {
  if (matrix.rows() == 0 || matrix.rows() != matrix.cols()) fail(what, matrix, "must be square and not empty");
  if (!matrix.allFinite()) fail(what, matrix, "must be finite");
}

Eigen::MatrixXd lowerFactor(const Eigen::MatrixXd& matrix, const std::string& what) {
  checkSquareAndFinite(matrix, what);
  if (!matrix.isApprox(matrix.transpose(), 1e-6)) fail(what, matrix, "must be symmetric");
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  if (cholesky.info() != Eigen::Success || !(cholesky.matrixLLT().diagonal().minCoeff() > 0))
    fail(what, matrix, "must be positive definite: give every direction of the residual some noise");
  return cholesky.matrixL();
}

}  // namespace

SquareRootInformation SquareRootInformation::fromCovariance(const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd lower = lowerFactor(covariance, "covariance");
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(lower.rows(), lower.cols());
  lower.triangularView<Eigen::Lower>().solveInPlace(inverse);
  if (!inverse.allFinite()) fail("covariance", covariance, "must not be so small that its inverse overflows");
  return SquareRootInformation(std::move(inverse));
}

SquareRootInformation SquareRootInformation::fromInformation(const Eigen::MatrixXd& information) {
  return SquareRootInformation(lowerFactor(information, "information").transpose());
}

SquareRootInformation SquareRootInformation::fromSigmas(const Eigen::VectorXd& sigmas) {
  for (const double sigma : sigmas)
    if (!(sigma > 0) || !std::isfinite(1 / sigma)) fail("sigmas", sigmas, "must be positive and finite");
  return fromMatrix(sigmas.cwiseInverse().asDiagonal());
}

SquareRootInformation SquareRootInformation::fromMatrix(const Eigen::MatrixXd& matrix) {
  checkSquareAndFinite(matrix, "square-root information");
  if (!Eigen::FullPivLU<Eigen::MatrixXd>(matrix).isInvertible())
    fail("square-root information", matrix, "must be invertible");
  return SquareRootInformation(matrix);
}

SquareRootInformation SquareRootInformation::identity(int size) {
  return fromMatrix(Eigen::MatrixXd::Identity(size, size));
}

Eigen::MatrixXd SquareRootInformation::covariance() const {
  const Eigen::MatrixXd inverse = matrix_.inverse();
  return inverse * inverse.transpose();
}

}  // namespace omnimapper::graph
