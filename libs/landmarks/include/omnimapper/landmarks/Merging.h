#pragma once

#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::landmarks {

/// How well a difference fits its covariance.
struct Fit {
  double chi2;
  double log_density;  ///< logarithm of the density of the difference, if both are the same
};
/// None if the covariance is not positive definite, or if a result is not finite.
std::optional<Fit> fitOf(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance);

/// The decision about two landmarks that were found to be the same, at the newest key frame. `chi2` is that of the
/// difference between them, and `limit` that of the test. `why` is the reason, if it is not this test.
mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit, const std::string& why = "");

}  // namespace omnimapper::landmarks
