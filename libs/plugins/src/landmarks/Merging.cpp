#include "Merging.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace omnimapper::plugins {

std::optional<double> chi2Of(const Eigen::VectorXd& difference, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  if (root.info() != Eigen::Success) return std::nullopt;
  const double chi2 = difference.dot(root.solve(difference));
  return std::isfinite(chi2) ? std::optional(chi2) : std::nullopt;
}

mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit) {
  mapper::Decision decision;
  decision.stamp = view.map.key_frames.back().stamp;
  decision.plugin = section;
  decision.kind = "merge";
  decision.from = view.map.key_frames.back().id;
  decision.accepted = true;
  decision.reason = "two landmarks are one";
  decision.numbers = {{"landmark", kept.index}, {"other", gone.index}, {"chi-square", chi2}, {"limit", limit}};
  return decision;
}

}  // namespace omnimapper::plugins
