#include "PointMerging.h"

#include <omnimapper/graph/ChiSquare.h>

#include <Eigen/Cholesky>
#include <optional>
#include <set>

#include "PointPayload.h"

namespace omnimapper::plugins {

namespace {

constexpr double kFarthestApart = 0.5;  // [m] whatever the covariance allows

bool seenAtOnce(base::VariableId a, base::VariableId b, const graph::Graph& graph) {
  std::set<base::VariableId> seen_from;
  for (const auto factor : graph.factorsOf(a)) seen_from.insert(graph.factor(factor).variables.front());
  for (const auto factor : graph.factorsOf(b))
    if (seen_from.count(graph.factor(factor).variables.front()) > 0) return true;
  return false;
}

std::optional<double> chi2OfGap(base::VariableId a, base::VariableId b, const mapper::View& view) {
  const auto joint = view.jointCovariance({a, b});
  if (!joint) return std::nullopt;
  const Eigen::VectorXd difference = view.graph.value(b) - view.graph.value(a);
  const Eigen::Index n = difference.size();
  const Eigen::MatrixXd covariance = joint->topLeftCorner(n, n) + joint->bottomRightCorner(n, n) -
                                     joint->topRightCorner(n, n) - joint->bottomLeftCorner(n, n);
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace

mapper::Batch mergeAlike(const KnownPoints& known, const PointLandmarksOptions& options, const std::string& section,
                         const mapper::View& view) {
  mapper::Batch batch;
  std::set<base::LandmarkId> merged;
  const auto nameless = [&](base::LandmarkId id) {
    return merged.count(id) == 0 && dynamic_cast<const PointPayload&>(*view.map.landmark(id).payload).number < 0;
  };
  const auto& all = known.all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end() && nameless(a->first); ++b) {
      const Eigen::VectorXd& there = view.graph.value(a->second);
      if (!nameless(b->first) || (view.graph.value(b->second) - there).norm() > kFarthestApart) continue;
      if (seenAtOnce(a->second, b->second, view.graph)) continue;
      const auto chi2 = chi2OfGap(a->second, b->second, view);
      const double limit = graph::chiSquareQuantile(options.confidence, static_cast<int>(there.size()));
      if (!chi2 || *chi2 > limit * options.inflation * options.inflation) continue;
      merged.insert({a->first, b->first});
      const auto& payload = dynamic_cast<const PointPayload&>(*view.map.landmark(a->first).payload);
      const auto& gone = dynamic_cast<const PointPayload&>(*view.map.landmark(b->first).payload);
      batch.mergeLandmarks(b->first, a->first, payload.with(gone));
      mapper::Decision decision;
      decision.stamp = view.map.key_frames.back().stamp;
      decision.plugin = section;
      decision.kind = "merge";
      decision.from = view.map.key_frames.back().id;
      decision.accepted = true;
      decision.reason = "two landmarks are one";
      decision.numbers = {
          {"landmark", a->first.index}, {"other", b->first.index}, {"chi-square", *chi2}, {"limit", limit}};
      batch.log(std::move(decision));
    }
  }
  return batch;
}

}  // namespace omnimapper::plugins
