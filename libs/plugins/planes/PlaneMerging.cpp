#include "PlaneMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Merging.h>
#include <omnimapper/landmarks/PlaneFactors.h>
#include <omnimapper/map/Level.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "LevelSurfaces.h"
#include "PlaneJudging.h"

namespace omnimapper::plugins {

namespace {

using Surface = PlaneLandmarkIndex::Surface;

constexpr double kTurn = 0.17, kOff = 0.15;  // [rad], [m] beyond which surfaces look like two
constexpr double kAlong = 0.94;              // cosine of the largest angle between two views of one surface

std::vector<Eigen::Vector3d> cornersOf(const Surface& surface) {
  const landmarks::PlaneAxes axes(surface.plane);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& corner : surface.hull) corners.push_back(axes.inSpace(corner));
  return corners;
}

bool overlap(const Surface& a, const Surface& b) {
  return gapBetween(a, cornersOf(b), b.heights) <= 0 && gapBetween(b, cornersOf(a), a.heights) <= 0;
}

// Fit of the difference between the planes of a and b to zero, by their joint covariance.
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

namespace {

// Whether the measured parts of two surfaces cover the same cells, a few centimetres apart. Two views of one surface
// differ by that much because of errors that all views of a sensor share, such as its distortion, which no covariance
// of a map includes. The distance may be larger, as between far views of one floor, if they cover each other nearly
// everywhere: of two different surfaces one would hide the other.
bool lieOnEachOther(const Surface& a, const Surface& b) {
  constexpr double kApart = 0.05, kShare = 0.3;         // [m], share of the smaller one
  constexpr double kFarApart = 0.07, kNearlyAll = 0.7;  // [m], share of the smaller one
  const bool a_is_smaller = a.seen.area() < b.seen.area();
  const Surface &smaller = a_is_smaller ? a : b, &larger = a_is_smaller ? b : a;
  std::size_t all = 0, shared = 0;
  double sum = 0;
  for (int row = 0; row < smaller.seen.rows(); ++row) {
    for (int column = 0; column < smaller.seen.columns(); ++column) {
      if (!smaller.seen.isSet({column, row})) continue;
      ++all;
      const Eigen::Vector3d point = smaller.seen.middleOf({column, row});
      const auto there = larger.seen.cellAt(point);
      if (!there || !larger.seen.isSet(*there)) continue;
      ++shared;
      const double off = signedDistance(larger.plane, point);
      sum += off * off;
    }
  }
  const double share = all > 0 ? static_cast<double>(shared) / static_cast<double>(all) : 0;
  const double apart = share >= kNearlyAll ? kFarApart : kApart;
  return share >= kShare && sum <= apart * apart * static_cast<double>(shared);
}

/// The floor of a map, from which heights on walls are measured.
struct Floor {
  Eigen::Vector3d up;  ///< unit normal, in the map
  double height;       ///< [m] along `up` from the map's origin
};

// None if the map does not know which way is up.
std::optional<Floor> floorOf(const PlaneLandmarkIndex& known, const mapper::View& view) {
  const auto* level = view.map.layers.find<map::Level>();
  if (level && !level->isKnown()) return std::nullopt;
  LevelSurfaces all(level);
  for (const auto& [id, surface] : known.all()) {
    surfaces::Surface one;
    one.plane = surface.plane;
    one.parts.push_back({cornersOf(surface), {}});
    all.add(one);
  }
  return Floor{level ? level->up : Eigen::Vector3d::UnitZ(),
               all.floor(known.emptyPayload().ground, view.map.key_frames)};
}

// Whether two surfaces are parts of one wall, with a door or furniture between them: both are upright, as high as walls
// and on one plane.
bool continueEachOther(const Surface& a, const Surface& b, const Floor& floor) {
  constexpr double kOneWall = 0.995, kOffPlane = 0.04, kFar = 2;           // cosine of the turn, [m], [m]
  constexpr double kUpright = 0.1, kHigh = 1.7, kLow = 0.7, kLeast = 0.5;  // z of the normal, [m], [m], [m^2]
  for (const Surface* one : {&a, &b}) {
    if (std::abs(one->plane.normal.dot(floor.up)) > kUpright || !(one->seen.area() > kLeast)) return false;
    double lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (const auto& corner : cornersOf(*one)) {
      lowest = std::min(lowest, corner.dot(floor.up) - floor.height);
      highest = std::max(highest, corner.dot(floor.up) - floor.height);
    }
    if (!(highest > kHigh && lowest < kLow)) return false;
  }
  return a.plane.normal.dot(b.plane.normal) > kOneWall && std::abs(signedDistance(a.plane, b.middle)) < kOffPlane &&
         std::abs(signedDistance(b.plane, a.middle)) < kOffPlane && gapBetween(a, cornersOf(b), b.heights) < kFar;
}

/// Which landmarks are merged, and the payloads of those that stay.
struct Merges {
  std::vector<std::pair<base::LandmarkId, base::LandmarkId>> gone_into;
  PlanePayloads payloads;
  mapper::Batch batch;  ///< all but the merges themselves
};

Merges findMerges(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                  const mapper::View& view, bool is_end) {
  known.update(view);
  const auto floor = is_end ? floorOf(known, view) : std::nullopt;
  const double limit = graph::chiSquareQuantile(options.confidence, known.form().variable()->tangentSize());
  // Two different surfaces could differ by anything within kOff and kTurn. They are merged only if it is
  // min_likelihood_ratio times likelier that they are one. If their relative pose is too uncertain for that, they are
  // not merged yet.
  const int turns = known.form().variable()->tangentSize() - 1;
  const double least_density =
      std::log(options.min_likelihood_ratio) - std::log(2 * kOff) - turns * std::log(2 * kTurn);
  Merges merges;
  std::set<base::LandmarkId> gone_already;
  std::set<base::FactorId> removed;
  std::map<base::LandmarkId, std::vector<const Surface*>> parts;  // that were merged into each
  const auto& all = known.all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b) {
      if (gone_already.count(a->first) > 0) break;
      if (gone_already.count(b->first) > 0 || !view.areAligned(a->first.session, b->first.session)) continue;
      if (a->second.plane.normal.dot(b->second.plane.normal) < kAlong) continue;
      const bool do_overlap = overlap(a->second, b->second);
      const bool lie = do_overlap && lieOnEachOther(a->second, b->second);
      if (!lie && !onOnePlane(a->second, b->second)) continue;
      const auto& of_a = parts[a->first];
      const bool continues = floor && (continueEachOther(a->second, b->second, *floor) ||
                                       std::any_of(of_a.begin(), of_a.end(), [&](const Surface* part) {
                                         return continueEachOther(*part, b->second, *floor);
                                       }));
      if (!continues && !do_overlap) continue;
      const auto fit = fitOfDifference(known.form(), a->second, b->second, options.inflation, view);
      if (!fit) continue;
      const bool is_alike = fit->chi2 <= limit && fit->log_density >= least_density;
      if (!continues && !is_alike && !lie) continue;
      const std::string why = is_alike    ? ""
                              : continues ? "parts of one wall, as high as walls and on one plane"
                                          : "their measured parts cover each other";
      gone_already.insert(b->first);
      parts[a->first].push_back(&b->second);
      const map::Landmark &kept = view.map.landmark(a->first), &gone = view.map.landmark(b->first);
      const auto before = merges.payloads.find(kept.id);
      const auto& kept_payload =
          before != merges.payloads.end() ? *before->second : dynamic_cast<const PlanePayload&>(*kept.payload);
      const auto& gone_payload = dynamic_cast<const PlanePayload&>(*gone.payload);
      const auto of_kept = uprightFactor(view.graph, kept.variables.front());
      const auto of_gone = uprightFactor(view.graph, gone.variables.front());
      const bool has_kept = of_kept && removed.count(*of_kept) == 0;
      if (of_gone) merges.batch.removeFactor(*of_gone);
      if (has_kept && !of_gone) {  // the tilt of the other one was measured
        merges.batch.removeFactor(*of_kept);
        removed.insert(*of_kept);
      }
      merges.gone_into.emplace_back(gone.id, kept.id);
      merges.payloads[kept.id] = kept_payload.with(gone_payload);
      merges.batch.log(landmarks::mergeDecision(view, section, kept.id, gone.id, fit->chi2, limit, why));
    }
  }
  return merges;
}

mapper::Batch asBatch(Merges merges) {
  for (const auto& [gone, kept] : merges.gone_into) merges.batch.mergeLandmarks(gone, kept, merges.payloads.at(kept));
  return std::move(merges.batch);
}

}  // namespace

mapper::Batch mergeAlike(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                         const mapper::View& view) {
  return asBatch(findMerges(known, options, section, view, false));
}

mapper::Batch mergeAndJudge(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                            const mapper::View& view) {
  Merges merges = findMerges(known, options, section, view, true);
  PlanePayloads left = merges.payloads;
  for (const auto& [id, surface] : known.all())
    left.try_emplace(id, std::dynamic_pointer_cast<const PlanePayload>(surface.payload));
  for (const auto& [gone, kept] : merges.gone_into) left.erase(gone);
  for (const auto& [id, payload] : judged(left, known, view)) {
    const auto merged = merges.payloads.find(id);
    if (merged != merges.payloads.end()) {
      merged->second = payload;
    } else {
      merges.batch.describeLandmark(id, payload);
    }
  }
  return asBatch(std::move(merges));
}

std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane) {
  for (const auto id : graph.factorsOf(plane))
    if (graph.factor(id).factor->kind() == landmarks::UprightFactor::kKind) return id;
  return std::nullopt;
}

}  // namespace omnimapper::plugins
