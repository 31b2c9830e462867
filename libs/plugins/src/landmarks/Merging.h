#pragma once

#include <omnimapper/mapper/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::plugins {

/// difference^T covariance^-1 difference; none if the covariance is none, or something is not finite.
std::optional<double> chi2Of(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance);

/// What the log says of two landmarks that were found to be one, now. `chi2`: of the difference between them; `limit`:
/// that of the test it passed.
mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit);

}  // namespace omnimapper::plugins
