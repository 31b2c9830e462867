#pragma once

#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::landmarks {

/// How well a difference fits its covariance.
struct Fit {
  double chi2;
  double log_density;  ///< logarithm of the difference's probability density, if its true value is 0
};
/// None if the covariance is not positive definite, or if a result is not finite.
std::optional<Fit> fitOf(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance);

/// The decision, at the newest key frame, that two landmarks are the same. `chi2`: of the difference between the two.
/// `limit`: the largest chi2 that the test accepts. `why`: an addition to the decision's reason; may be empty.
mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit, const std::string& why = "");

}  // namespace omnimapper::landmarks
