#pragma once

#include <omnimapper/plugin/State.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::landmarks {

/// How well a difference fits its covariance.
struct Fit {
  double chi2;
  double log_density;  ///< logarithm of the difference's probability density, if its true value is 0
};
/// None if the covariance is not positive definite, or if a result is not finite.
std::optional<Fit> fitOf(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance);

/// Fit of the difference between two points to zero, by the joint covariance of their variables (point2 or point3).
/// `sigma` [m]: of the difference between two estimates of one point, in addition to that covariance. None if the
/// covariance is unknown, and as fitOf().
std::optional<Fit> fitOfGap(base::VariableId a, base::VariableId b, const mapper::State& state, double sigma = 0);

}  // namespace omnimapper::landmarks
