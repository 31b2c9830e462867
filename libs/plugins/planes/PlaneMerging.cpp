#include "PlaneMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Merging.h>
#include <omnimapper/landmarks/PlaneFactors.h>

#include <cmath>
#include <set>

namespace omnimapper::plugins {

namespace {

using Surface = PlaneLandmarkIndex::Surface;

constexpr double kTurn = 0.17, kOff = 0.15;  // [rad], [m] what is farther apart looks like two

std::vector<Eigen::Vector3d> cornersOf(const Surface& surface) {
  const landmarks::PlaneAxes axes(surface.plane);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& corner : surface.hull) corners.push_back(axes.inSpace(corner));
  return corners;
}

bool overlap(const Surface& a, const Surface& b) {
  return gapBetween(a, cornersOf(b), b.heights) <= 0 && gapBetween(b, cornersOf(a), a.heights) <= 0;
}

// Of the change that takes a's plane to b's, by all that ties them together.
std::optional<landmarks::Fit> fitOfDifference(const landmarks::PlaneParametrization& form, const Surface& a,
                                              const Surface& b, double inflation, const mapper::View& view) {
  const auto joint = view.jointCovariance({a.variable, b.variable});
  if (!joint) return std::nullopt;
  const auto [change, by_both] = form.difference(view.graph.value(a.variable), view.graph.value(b.variable));
  return landmarks::fitOf(change, inflation * inflation * by_both * *joint * by_both.transpose());
}

}  // namespace

bool onOnePlane(const Surface& a, const Surface& b) {
  if (a.hull.empty() || b.hull.empty()) return false;
  if (a.plane.normal.dot(b.plane.normal) < std::cos(kTurn)) return false;
  const Surface &larger = a.radius > b.radius ? a : b, &smaller = a.radius > b.radius ? b : a;
  return std::abs(signedDistance(larger.plane, smaller.middle)) <= kOff;
}

mapper::Batch mergeAlike(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                         const mapper::View& view) {
  known.update(view);
  const double limit = graph::chiSquareQuantile(options.confidence, known.form().variable()->tangentSize());
  // Two surfaces may lie anyhow within those bounds: that they are one must be so many times likelier. Where little is
  // known of how they lie to each other, nobody can tell, and they wait.
  const int turns = known.form().variable()->tangentSize() - 1;
  const double least_density =
      std::log(options.min_likelihood_ratio) - std::log(2 * kOff) - turns * std::log(2 * kTurn);
  mapper::Batch batch;
  std::set<base::LandmarkId> merged;
  const auto& all = known.all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b) {
      if (merged.count(a->first) > 0) break;
      if (merged.count(b->first) > 0 || !view.areJoined(a->first.session, b->first.session)) continue;
      if (!onOnePlane(a->second, b->second) || !overlap(a->second, b->second)) continue;
      const auto fit = fitOfDifference(known.form(), a->second, b->second, options.inflation, view);
      if (!fit || fit->chi2 > limit || fit->log_density < least_density) continue;
      merged.insert(a->first);
      merged.insert(b->first);
      const map::Landmark &kept = view.map.landmark(a->first), &gone = view.map.landmark(b->first);
      const auto& kept_payload = dynamic_cast<const PlanePayload&>(*kept.payload);
      const auto& gone_payload = dynamic_cast<const PlanePayload&>(*gone.payload);
      const auto of_kept = uprightFactor(view.graph, kept.variables.front());
      const auto of_gone = uprightFactor(view.graph, gone.variables.front());
      if (of_gone) batch.removeFactor(*of_gone);
      if (of_kept && !of_gone) batch.removeFactor(*of_kept);  // something showed how the other leans
      batch.mergeLandmarks(gone.id, kept.id, kept_payload.with(gone_payload));
      batch.log(landmarks::mergeDecision(view, section, kept.id, gone.id, fit->chi2, limit));
    }
  }
  return batch;
}

std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane) {
  for (const auto id : graph.factorsOf(plane))
    if (graph.factor(id).factor->kind() == landmarks::UprightFactor::kKind) return id;
  return std::nullopt;
}

}  // namespace omnimapper::plugins
