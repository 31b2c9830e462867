#include "ObjectMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Fit.h>

#include <algorithm>
#include <set>
#include <vector>

namespace omnimapper::plugins {

namespace {

std::set<base::VariableId> posesThatSaw(base::VariableId object, const graph::Graph& graph) {
  std::set<base::VariableId> poses;
  for (const auto factor : graph.factorsOf(object)) poses.insert(graph.factor(factor).variables.front());
  return poses;
}

bool wereSeenAtOnce(base::VariableId a, base::VariableId b, const graph::Graph& graph) {
  const auto from_a = posesThatSaw(a, graph), from_b = posesThatSaw(b, graph);
  return std::any_of(from_a.begin(), from_a.end(), [&](auto pose) { return from_b.count(pose) > 0; });
}

// The larger of the shares of the points of either object that are near the other's.
double largerOverlap(const ObjectGeometry& a, const ObjectGeometry& b) {
  if (!a.bounds.intersects(b.bounds)) return 0;
  return std::max(shareNear(a.grid, b.points), shareNear(b.grid, a.points));
}

// Whether both are at one place: unlike those of two things that touch, most points of either are within about a
// centimetre of the other's.
bool areAtOnePlace(const ObjectGeometry& a, const ObjectGeometry& b, double share) {
  constexpr double kReach = 0.01;  // [m]
  return shareNear(PointGrid(kReach, a.points), b.points) >= share &&
         shareNear(PointGrid(kReach, b.points), a.points) >= share;
}

}  // namespace

landmarks::LandmarkMerging<ObjectPayload> mergeObjects(const ObjectIndex& known, const ObjectLandmarksOptions& options,
                                                       const std::string& section, const mapper::View& view) {
  landmarks::LandmarkMerging<ObjectPayload> merging(view, section);
  const double limit = graph::chiSquareQuantile(options.confidence, 3) * options.inflation * options.inflation;
  std::vector<const KnownObject*> objects;
  for (const auto& [id, object] : known.all()) objects.push_back(&object);
  const auto placeOf = [&](const KnownObject& object) -> const Eigen::VectorXd& {
    return view.graph.value(object.variable);
  };
  std::stable_sort(objects.begin(), objects.end(),
                   [&](const auto* a, const auto* b) { return placeOf(*a).x() < placeOf(*b).x(); });
  constexpr double kFarthestApart = 1;  // [m] between the middles of objects that are merged
  for (auto a = objects.begin(); a != objects.end(); ++a) {
    for (auto b = std::next(a); b != objects.end() && placeOf(**b).x() - placeOf(**a).x() <= kFarthestApart; ++b) {
      const KnownObject &kept = (*a)->id < (*b)->id ? **a : **b, &gone = (*a)->id < (*b)->id ? **b : **a;
      // Two parts of one object may not be seen at once either, which is known when the first merge has been applied.
      if (!merging.mayMerge(kept.id, gone.id) || !merging.partsOf(kept.id).empty()) continue;
      if ((placeOf(kept) - placeOf(gone)).norm() > kFarthestApart) continue;
      const auto &at = kept.geometry(view.map.key_frames), &other = gone.geometry(view.map.key_frames);
      if (largerOverlap(at, other) < options.merge_overlap) continue;
      // Two objects cannot be at one place: such a thing was found in pieces.
      if (wereSeenAtOnce(kept.variable, gone.variable, view.graph) && !areAtOnePlace(at, other, options.merge_overlap))
        continue;
      const double sigma = options.size_share * std::max(at.box.size.norm(), other.box.size.norm());
      const auto fit = landmarks::fitOfGap(kept.variable, gone.variable, view, sigma);
      if (!fit || fit->chi2 > limit) continue;
      ObjectPayload with_looks = merging.payloadOf(gone.id);  // nothing was merged into it
      for (const auto& [sight, stamp] : gone.looks) with_looks.evidence.add(sight, stamp);
      merging.merge(kept.id, gone.id, {fit->chi2, limit, "their points overlap"},
                    merging.payloadOf(kept.id).with(with_looks, view.map.key_frames, options.limits()));
    }
  }
  return merging;
}

ObjectModel withoutOthers(const KnownObject& object, const ObjectModel& model, const ObjectIndex& known,
                          const ObjectLandmarksOptions& options, const mapper::View& view) {
  constexpr double kReach = 0.01;  // [m]
  ObjectModel rest = model;
  const auto& own = object.geometry(view.map.key_frames);
  for (const auto& [id, other] : known.all()) {
    if (id == object.id || !other.payload->is_confirmed) continue;
    const auto& there = other.geometry(view.map.key_frames);
    if (!own.bounds.intersects(there.bounds) || shareNear(own.grid, there.points) < options.merge_overlap ||
        shareNear(there.grid, own.points) >= options.merge_overlap ||
        !wereSeenAtOnce(object.variable, other.variable, view.graph))
      continue;
    const PointGrid taken(kReach, there.points);
    auto without =
        rest.without([&](const Eigen::Vector3f& point) { return taken.hasNear(point); }, view.map.key_frames);
    if (!without.empty()) rest = std::move(without);
  }
  return rest;
}

}  // namespace omnimapper::plugins
