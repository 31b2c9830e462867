#include <omnimapper/interaction/PointingTarget.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "Sight.h"

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;

constexpr double kOneDegree = M_PI / 180;
constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

double mahalanobis(const PointingGesture& gesture, const Vector3d& target, const PointingModel& model,
                   PointingMethod method, bool is_squared) {
  const auto errors = errorsOf(gesture, target);
  const bool is_head = method == PointingMethod::head_hand;
  const auto& error = is_head ? errors.head_hand : errors.elbow_hand;
  if (!error) return kFar;
  const PointingRow row = errorsTowards(model, directionOf(gesture, target));
  const RayErrors& known = is_head ? row.head_hand : row.elbow_hand;
  const auto part = [&](double measured, const AngleError& angle) {
    const double off = (measured - angle.mean) / kOneDegree, sigma = angle.sigma / kOneDegree;
    return off * off / (is_squared ? sigma * sigma : sigma);
  };
  return std::sqrt(part(error->theta, known.theta) + part(error->psi, known.psi));
}

TargetAnswer determineTargetAsThesis(const PointingGesture& gesture, const std::vector<PointedCandidate>& candidates,
                                     const PointingModel& model, PointingMethod method, const ThesisRule& rule) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    double least = kFar;
    for (const Vector3d& point : candidates[i].points)
      least = std::min(least, mahalanobis(gesture, point, model, method, false));
    if (candidates[i].may_be_meant && least <= rule.max_distance) near.emplace_back(least, i);
  }
  std::sort(near.begin(), near.end());
  TargetAnswer answer;
  answer.probabilities.assign(candidates.size(), 0.0);
  if (near.size() >= 2 && near[0].first > rule.max_ratio * near[1].first) {
    answer.verdict = TargetVerdict::one_of_these;
    for (const auto& [distance, candidate] : near) answer.candidates.push_back(candidate);
    return answer;
  }
  std::optional<std::size_t> found;
  const auto& from = method == PointingMethod::head_hand ? gesture.head : gesture.elbow;
  if (!near.empty()) {
    found = near[0].second;
  } else if (from && (gesture.hand - *from).norm() > 0) {
    found = Sight(gesture.hand, candidates).surfaceAt((gesture.hand - *from).normalized());
  }
  if (found && candidates[*found].may_be_meant) {
    answer.verdict = TargetVerdict::this_one;
    answer.candidates = {*found};
  }
  return answer;
}

}  // namespace omnimapper::interaction
