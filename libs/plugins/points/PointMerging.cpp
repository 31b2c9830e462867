#include "PointMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Merging.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "PointPayload.h"

namespace omnimapper::plugins {

namespace {

constexpr double kFarthestApart = 0.5;  // [m] between landmarks that are merged, whatever the covariance allows

bool seenAtOnce(base::VariableId a, base::VariableId b, const graph::Graph& graph) {
  std::set<base::VariableId> seen_from;
  for (const auto factor : graph.factorsOf(a)) seen_from.insert(graph.factor(factor).variables.front());
  for (const auto factor : graph.factorsOf(b))
    if (seen_from.count(graph.factor(factor).variables.front()) > 0) return true;
  return false;
}

std::optional<landmarks::Fit> fitOfGap(base::VariableId a, base::VariableId b, const mapper::View& view) {
  const auto joint = view.jointCovariance({a, b});
  if (!joint) return std::nullopt;
  const Eigen::VectorXd difference = view.graph.value(b) - view.graph.value(a);
  const Eigen::Index n = difference.size();
  return landmarks::fitOf(difference, joint->topLeftCorner(n, n) + joint->bottomRightCorner(n, n) -
                                          joint->topRightCorner(n, n) - joint->bottomLeftCorner(n, n));
}

struct UnnumberedPoint {
  base::LandmarkId id;
  base::VariableId variable;
  const Eigen::VectorXd* place;  // [m] in the map
};

// Sorted by x, so that the search for near neighbours can stop early.
std::vector<UnnumberedPoint> unnumberedPoints(const PointLandmarkIndex& known, const mapper::View& view) {
  std::vector<UnnumberedPoint> unnumbered;
  for (const auto& [id, variable] : known.all()) {
    const auto& payload = dynamic_cast<const PointPayload&>(*view.map.landmark(id).payload);
    if (payload.number < 0) unnumbered.push_back({id, variable, &view.graph.value(variable)});
  }
  std::stable_sort(unnumbered.begin(), unnumbered.end(),
                   [](const UnnumberedPoint& a, const UnnumberedPoint& b) { return (*a.place)[0] < (*b.place)[0]; });
  return unnumbered;
}

}  // namespace

mapper::Batch mergeAlike(const PointLandmarkIndex& known, const PointLandmarksOptions& options,
                         const std::string& section, const mapper::View& view) {
  mapper::Batch batch;
  std::vector<UnnumberedPoint> left = unnumberedPoints(known, view);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const UnnumberedPoint& a = left[i];
    const double limit = graph::chiSquareQuantile(options.confidence, static_cast<int>(a.place->size())) *
                         options.inflation * options.inflation;
    for (std::size_t k = i + 1; k < left.size() && (*left[k].place)[0] - (*a.place)[0] <= kFarthestApart; ++k) {
      const UnnumberedPoint& b = left[k];
      if ((*b.place - *a.place).norm() > kFarthestApart || !view.areAligned(a.id.session, b.id.session)) continue;
      if (seenAtOnce(a.variable, b.variable, view.graph)) continue;
      const auto fit = fitOfGap(a.variable, b.variable, view);
      if (!fit || fit->chi2 > limit) continue;
      const auto kept = std::min(a.id, b.id), gone = std::max(a.id, b.id);
      const auto payloadOf = [&](base::LandmarkId id) -> const PointPayload& {
        return dynamic_cast<const PointPayload&>(*view.map.landmark(id).payload);
      };
      batch.mergeLandmarks(gone, kept, payloadOf(kept).with(payloadOf(gone)));
      batch.log(landmarks::mergeDecision(view, section, kept, gone, fit->chi2, limit));
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
  }
  return batch;
}

}  // namespace omnimapper::plugins
