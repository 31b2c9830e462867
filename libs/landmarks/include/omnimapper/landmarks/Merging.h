#pragma once

#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::landmarks {

/// How well a difference fits to what is not known of it.
struct Fit {
  double chi2;
  double log_density;  ///< of the difference, if both are one
};
/// None if the covariance is none, or something is not finite.
std::optional<Fit> fitOf(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance);

/// What the log says of two landmarks that were found to be one, now. `chi2`: of the difference between them; `limit`:
/// that of the test for it. `why` they are one, where it is not that test that told.
mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit, const std::string& why = "");

}  // namespace omnimapper::landmarks
