#include "PointMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/landmarks/LandmarkMerging.h>

#include <algorithm>
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

struct UnnumberedPoint {
  base::LandmarkId id;
  base::VariableId variable;
  const Eigen::VectorXd* place;  // [m] in the map
};

// Sorted by x, so that the search for near neighbours can stop early.
std::vector<UnnumberedPoint> unnumberedPoints(const PointLandmarkIndex& known, const mapper::View& view) {
  std::vector<UnnumberedPoint> unnumbered;
  for (const auto& [id, point] : known.all())
    if (point.number < 0) unnumbered.push_back({id, point.variable, &view.graph.value(point.variable)});
  std::stable_sort(unnumbered.begin(), unnumbered.end(),
                   [](const UnnumberedPoint& a, const UnnumberedPoint& b) { return (*a.place)[0] < (*b.place)[0]; });
  return unnumbered;
}

}  // namespace

mapper::Batch mergeAlike(const PointLandmarkIndex& known, const PointLandmarksOptions& options,
                         const std::string& section, const mapper::View& view) {
  landmarks::LandmarkMerging<PointPayload> merging(view, section);
  const std::vector<UnnumberedPoint> points = unnumberedPoints(known, view);
  for (auto a = points.begin(); a != points.end(); ++a) {
    const double limit = graph::chiSquareQuantile(options.confidence, static_cast<int>(a->place->size())) *
                         options.inflation * options.inflation;
    for (auto b = std::next(a); b != points.end() && (*b->place)[0] - (*a->place)[0] <= kFarthestApart; ++b) {
      const auto kept = std::min(a->id, b->id), gone = std::max(a->id, b->id);
      // Two parts of one landmark may not be seen at once either, which is known when the first merge has been applied.
      if (!merging.mayMerge(kept, gone) || !merging.partsOf(kept).empty()) continue;
      if ((*b->place - *a->place).norm() > kFarthestApart) continue;
      if (seenAtOnce(a->variable, b->variable, view.graph)) continue;
      const auto fit = landmarks::fitOfGap(a->variable, b->variable, view);
      if (fit && fit->chi2 <= limit) merging.merge(kept, gone, {fit->chi2, limit, ""});
    }
  }
  return merging.take();
}

}  // namespace omnimapper::plugins
