#include "PlaneMerging.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/landmarks/LandmarkMerging.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/plane_factors/PlaneFactors.h>

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

using Surface = LandmarkSurface;

constexpr double kTurn = 0.17, kOff = 0.15;  // [rad], [m] beyond which surfaces look like two
constexpr double kAlong = 0.94;              // cosine of the largest angle between two views of one surface

std::vector<Eigen::Vector3d> cornersOf(const Surface& surface) {
  const plane_factors::PlaneAxes axes(surface.plane);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& corner : surface.hull) corners.push_back(axes.inSpace(corner));
  return corners;
}

bool overlap(const Surface& a, const Surface& b) {
  return gapBetween(a, cornersOf(b), b.heights) <= 0 && gapBetween(b, cornersOf(a), a.heights) <= 0;
}

// Fit of the difference between the planes of a and b to zero, by their joint covariance.
std::optional<landmarks::Fit> fitOfDifference(const plane_factors::PlaneParametrization& form, const Surface& a,
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

using Merging = landmarks::LandmarkMerging<PlanePayload>;

// Finds out whether two surfaces are one.
class Comparison {
 public:
  Comparison(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const mapper::View& view,
             std::optional<Floor> floor)
      : known_(known),
        view_(view),
        floor_(std::move(floor)),
        inflation_(options.inflation),
        limit_(graph::chiSquareQuantile(options.confidence, known.form().variable()->tangentSize())) {
    // Two different surfaces could differ by anything within kOff and kTurn. They are merged only if it is
    // min_likelihood_ratio times likelier that they are one. If their relative pose is too uncertain for that, they are
    // not merged yet.
    const int turns = known.form().variable()->tangentSize() - 1;
    least_density_ = std::log(options.min_likelihood_ratio) - std::log(2 * kOff) - turns * std::log(2 * kTurn);
  }

  // `parts_of_a`: landmarks that are merged into a already.
  std::optional<landmarks::Sameness> compare(const Surface& a, const Surface& b,
                                             const std::vector<base::LandmarkId>& parts_of_a) const {
    if (a.plane.normal.dot(b.plane.normal) < kAlong) return std::nullopt;
    const bool do_overlap = overlap(a, b);
    const bool lie = do_overlap && lieOnEachOther(a, b);
    if (!lie && !onOnePlane(a, b)) return std::nullopt;
    const bool continues = floor_ && (continueEachOther(a, b, *floor_) ||
                                      std::any_of(parts_of_a.begin(), parts_of_a.end(), [&](base::LandmarkId part) {
                                        return continueEachOther(known_.at(part), b, *floor_);
                                      }));
    if (!continues && !do_overlap) return std::nullopt;
    const auto fit = fitOfDifference(known_.form(), a, b, inflation_, view_);
    if (!fit) return std::nullopt;
    const bool is_alike = fit->chi2 <= limit_ && fit->log_density >= least_density_;
    if (!continues && !is_alike && !lie) return std::nullopt;
    const char* why = is_alike    ? ""
                      : continues ? "parts of one wall, as high as walls and on one plane"
                                  : "their measured parts cover each other";
    return landmarks::Sameness{fit->chi2, limit_, why};
  }

 private:
  const PlaneLandmarkIndex& known_;
  const mapper::View& view_;
  std::optional<Floor> floor_;  // only at the end of a run
  double inflation_, limit_, least_density_;
};

// Removes the factors that hold planes upright whose tilt was measured. `removed`: by earlier merges.
void removeUprightFactors(const Surface& kept, const Surface& gone, const graph::Graph& graph, mapper::Batch& batch,
                          std::set<base::FactorId>& removed) {
  const auto of_kept = uprightFactor(graph, kept.variable), of_gone = uprightFactor(graph, gone.variable);
  if (of_gone) batch.removeFactor(*of_gone);
  // If the other one has none, its tilt was measured.
  if (of_kept && !of_gone && removed.insert(*of_kept).second) batch.removeFactor(*of_kept);
}

Merging findMerges(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                   const mapper::View& view, bool is_end) {
  const Comparison comparison(known, options, view, is_end ? floorOf(known, view) : std::nullopt);
  Merging merging(view, section);
  std::set<base::FactorId> removed;
  const auto& all = known.all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b) {
      if (!merging.mayMerge(a->first, b->first)) continue;
      const auto sameness = comparison.compare(a->second, b->second, merging.partsOf(a->first));
      if (!sameness) continue;
      removeUprightFactors(a->second, b->second, view.graph, merging.batch(), removed);
      merging.merge(a->first, b->first, *sameness);
    }
  }
  return merging;
}

}  // namespace

mapper::Batch mergeAlike(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options,
                         const std::string& section, const mapper::View& view) {
  return findMerges(known, options, section, view, false).take();
}

mapper::Batch mergeAndJudge(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options,
                            const std::string& section, const mapper::View& view) {
  Merging merging = findMerges(known, options, section, view, true);
  PlanePayloads left = merging.payloads();
  for (const auto& [id, surface] : known.all())
    if (!merging.isGone(id)) left.try_emplace(id, std::dynamic_pointer_cast<const PlanePayload>(surface.payload));
  for (const auto& [id, payload] : judged(left, known, view)) merging.describe(id, payload);
  return merging.take();
}

std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane) {
  for (const auto id : graph.factorsOf(plane))
    if (graph.factor(id).factor->kind() == plane_factors::UprightFactor::kKind) return id;
  return std::nullopt;
}

}  // namespace omnimapper::plugins
