#include <omnimapper/geometry/Angle.h>
#include <omnimapper/landmarks/Merging.h>

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

mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, double chi2, double limit, const std::string& why) {
  mapper::Decision decision;
  decision.stamp = view.map.key_frames.back().stamp;
  decision.plugin = section;
  decision.kind = "merge";
  decision.from = view.map.key_frames.back().id;
  decision.accepted = true;
  decision.reason = "two landmarks are the same" + (why.empty() ? why : ": " + why);
  decision.numbers = {{"landmark", kept.index}, {"other", gone.index}, {"chi-square", chi2}, {"limit", limit}};
  return decision;
}

}  // namespace omnimapper::landmarks
