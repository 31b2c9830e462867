#include <omnimapper/interaction/PointingTarget.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "PointingLikelihood.h"
#include "Sight.h"

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;

// Solid angle over which the target of a gesture that means none of the candidates may lie [sr].
constexpr double kAnywhere = 4 * M_PI;
// Of an object with many points, every n-th counts, so that at most this many are used.
constexpr std::size_t kMostPoints = 64;
constexpr std::size_t kMostAsked = 4;

double ofObject(const PointingLikelihood& likelihood, const Sight& sight, const PointedCandidate& candidate,
                std::size_t index) {
  const std::size_t step = (candidate.points.size() + kMostPoints - 1) / kMostPoints;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < candidate.points.size(); i += step) {
    ++count;
    const double here = likelihood.towards(candidate.points[i]);
    if (here > 0 && !sight.isHidden(candidate.points[i], index)) sum += here;
  }
  return sum / count;
}

// The mean over the directions in which a surface is seen.
void addSurfaces(const PointingGesture& gesture, const PointingLikelihood& likelihood, const Sight& sight,
                 std::vector<double>& likelihoods) {
  std::vector<double> sums(likelihoods.size(), 0.0);
  for (const auto& direction : likelihood.directions())
    if (const auto surface = sight.surfaceAt(direction.unit))
      sums[*surface] += direction.weight * likelihood.towards(gesture.hand + direction.unit);
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (sums[i] > 0) likelihoods[i] += sums[i] / sight.seenAngle(i);
}

void decide(const TargetOptions& options, TargetAnswer& answer) {
  const auto& p = answer.probabilities;
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] > p[b]; });
  if (!order.empty() && p[order[0]] >= options.sure) {
    answer.verdict = TargetVerdict::this_one;
    answer.candidates = {order[0]};
    return;
  }
  if (answer.nothing >= 0.5) return;
  answer.verdict = TargetVerdict::one_of_these;
  double sum = 0;
  for (const std::size_t i : order) {
    if (answer.candidates.size() >= kMostAsked || sum >= options.sure * (1 - answer.nothing)) break;
    answer.candidates.push_back(i);
    sum += p[i];
  }
}

}  // namespace

const base::OptionTable<TargetOptions>& TargetOptions::table() {
  using O = TargetOptions;
  static const auto table =
      base::OptionTable<O>()
          .choice("rays", &O::method,
                  {{"both", PointingMethod::both},
                   {"elbow_hand", PointingMethod::elbow_hand},
                   {"head_hand", PointingMethod::head_hand}},
                  "Rays by which the target is determined.")
          .number("nothing_probability", &O::nothing_prior, {0.001, 0.999},
                  "Probability that a gesture means nothing that is mapped, before it is seen.")
          .number("degrees_of_freedom", &O::freedom, {1, 1000},
                  "Of Student's distribution of the errors of pointing: the fewer, the more often people miss widely.")
          .number("sure_probability", &O::sure, {0.5, 1}, "Probability from which on a target is not asked back.")
          .number("max_range_m", &O::max_range, base::Range::positive(),
                  "Farthest distance from the hand of what is pointed at.");
  return table;
}

TargetDirection directionOf(const PointingGesture& gesture, const Vector3d& target) {
  const Vector3d to_target = target - gesture.hand, to_sensor = gesture.sensor - gesture.hand;
  const double turn = std::atan2(to_sensor.x() * to_target.y() - to_sensor.y() * to_target.x(),
                                 to_sensor.x() * to_target.x() + to_sensor.y() * to_target.y());
  return {gesture.is_right_arm ? -turn : turn, std::atan2(to_target.z(), to_target.head<2>().norm())};
}

GestureErrors errorsOf(const PointingGesture& gesture, const Vector3d& target) {
  const auto errorOf = [&](const std::optional<Vector3d>& from) -> std::optional<PointingError> {
    if (!from) return std::nullopt;
    auto error = pointingErrorOf(gesture.hand, gesture.hand - *from, target);
    if (!gesture.is_right_arm) error.theta = -error.theta;
    return error;
  };
  return {errorOf(gesture.elbow), errorOf(gesture.head)};
}

TargetAnswer determineTarget(const PointingGesture& gesture, const std::vector<PointedCandidate>& candidates,
                             const PointingModel& model, const TargetOptions& options) {
  TargetAnswer answer;
  answer.probabilities.assign(candidates.size(), 0.0);
  const PointingLikelihood likelihood(gesture, model, options);
  if (!likelihood.isKnown()) return answer;
  const Sight sight(gesture.hand, candidates);
  std::vector<double> likelihoods(candidates.size(), 0.0);
  if (sight.hasSurfaces()) addSurfaces(gesture, likelihood, sight, likelihoods);
  double meant = 0;  // sum of the weights
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!candidates[i].may_be_meant || sight.rangeOf(i) > options.max_range || !sight.isSeen(i)) {
      likelihoods[i] = 0;
      continue;
    }
    meant += candidates[i].weight;
    likelihoods[i] *= candidates[i].weight;
    if (!candidates[i].points.empty())
      likelihoods[i] += candidates[i].weight * ofObject(likelihood, sight, candidates[i], i);
  }
  if (!(meant > 0)) return answer;
  const double prior = (1 - options.nothing_prior) / meant;
  const double nothing = options.nothing_prior / kAnywhere;
  const double sum = std::accumulate(likelihoods.begin(), likelihoods.end(), 0.0) * prior + nothing;
  for (std::size_t i = 0; i < candidates.size(); ++i) answer.probabilities[i] = likelihoods[i] * prior / sum;
  answer.nothing = nothing / sum;
  decide(options, answer);
  return answer;
}

}  // namespace omnimapper::interaction
