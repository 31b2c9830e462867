#include <omnimapper/geometry/Angle.h>
#include <omnimapper/landmarks/Fit.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace omnimapper::landmarks {

std::optional<Fit> fitOf(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  if (root.info() != Eigen::Success) return std::nullopt;
  Fit fit;
  fit.chi2 = difference.dot(root.solve(difference));
  const double root_log_determinant = Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
  const auto size = static_cast<double>(difference.size());
  fit.log_density = -0.5 * (fit.chi2 + size * std::log(2 * geometry::kPi)) - root_log_determinant;
  if (!std::isfinite(fit.log_density)) return std::nullopt;
  return fit;
}

std::optional<Fit> fitOfGap(base::VariableId a, base::VariableId b, const mapper::State& state, double sigma) {
  const auto joint = state.jointCovariance({a, b});
  if (!joint) return std::nullopt;
  const Eigen::VectorXd difference = state.graph.value(b) - state.graph.value(a);
  const Eigen::Index n = difference.size();
  const Eigen::MatrixXd covariance = joint->topLeftCorner(n, n) + joint->bottomRightCorner(n, n) -
                                     joint->topRightCorner(n, n) - joint->bottomLeftCorner(n, n) +
                                     sigma * sigma * Eigen::MatrixXd::Identity(n, n);
  return fitOf(difference, covariance);
}

}  // namespace omnimapper::landmarks
