#include "PlaneMerging.h"

#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Merging.h>
#include <omnimapper/landmarks/PlaneFactors.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

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

namespace {

// Whether what was seen of two surfaces covers the same cells, a few centimetres apart: how far two views of one
// surface lie apart by what all views of a sensor have in common, such as its distortion, which no covariance of a map
// knows.
bool lieOnEachOther(const Surface& a, const Surface& b) {
  constexpr double kAlong = 0.94, kApart = 0.05, kShare = 0.3;  // cosine of the turn, [m], of the smaller one
  if (a.plane.normal.dot(b.plane.normal) < kAlong) return false;
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
  return all > 0 && static_cast<double>(shared) >= kShare * static_cast<double>(all) &&
         sum <= kApart * kApart * static_cast<double>(shared);
}

// Whether two parts of one wall, with a door or furniture between them: upright, as high as walls, on one plane from
// one end to the other.
bool continueEachOther(const Surface& a, const Surface& b, double ground) {
  constexpr double kAlong = 0.995, kOffPlane = 0.04, kFar = 2;             // cosine of the turn, [m], [m]
  constexpr double kUpright = 0.1, kHigh = 1.7, kLow = 0.7, kLeast = 0.5;  // of the normal's height, [m], [m], [m^2]
  for (const Surface* one : {&a, &b}) {
    const bool is_tall = one->highest - ground > kHigh && one->lowest - ground < kLow && one->seen.area() > kLeast;
    if (!is_tall || std::abs(one->plane.normal.z()) > kUpright) return false;
  }
  return a.plane.normal.dot(b.plane.normal) > kAlong && std::abs(signedDistance(a.plane, b.middle)) < kOffPlane &&
         std::abs(signedDistance(b.plane, a.middle)) < kOffPlane && gapBetween(a, cornersOf(b), b.heights) < kFar;
}

/// Which landmarks become one, and what is known of those that stay.
struct Merges {
  std::vector<std::pair<base::LandmarkId, base::LandmarkId>> gone_into;
  std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>> payloads;
  mapper::Batch batch;  ///< all but the merges themselves
};

Merges findMerges(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                  const mapper::View& view, bool is_end) {
  known.update(view);
  const double ground = known.emptyPayload().groundIn(view.map.key_frames);
  const double limit = graph::chiSquareQuantile(options.confidence, known.form().variable()->tangentSize());
  // Two surfaces may lie anyhow within those bounds: that they are one must be so many times likelier. Where little is
  // known of how they lie to each other, nobody can tell, and they wait.
  const int turns = known.form().variable()->tangentSize() - 1;
  const double least_density =
      std::log(options.min_likelihood_ratio) - std::log(2 * kOff) - turns * std::log(2 * kTurn);
  Merges merges;
  std::set<base::LandmarkId> gone_already;
  std::set<base::FactorId> removed;
  std::map<base::LandmarkId, std::vector<const Surface*>> parts;  // that one has taken in
  const auto& all = known.all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b) {
      if (gone_already.count(a->first) > 0) break;
      if (gone_already.count(b->first) > 0 || !view.areJoined(a->first.session, b->first.session)) continue;
      const bool lie = overlap(a->second, b->second) && lieOnEachOther(a->second, b->second);
      if (!lie && !onOnePlane(a->second, b->second)) continue;
      const auto& of_a = parts[a->first];
      const bool continues = is_end && (continueEachOther(a->second, b->second, ground) ||
                                        std::any_of(of_a.begin(), of_a.end(), [&](const Surface* part) {
                                          return continueEachOther(*part, b->second, ground);
                                        }));
      if (!continues && !overlap(a->second, b->second)) continue;
      const auto fit = fitOfDifference(known.form(), a->second, b->second, options.inflation, view);
      if (!fit) continue;
      const bool is_alike = fit->chi2 <= limit && fit->log_density >= least_density;
      if (!continues && !is_alike && !lie) continue;
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
      if (has_kept && !of_gone) {  // something showed how the other leans
        merges.batch.removeFactor(*of_kept);
        removed.insert(*of_kept);
      }
      merges.gone_into.emplace_back(gone.id, kept.id);
      merges.payloads[kept.id] = kept_payload.with(gone_payload);
      merges.batch.log(landmarks::mergeDecision(view, section, kept.id, gone.id, fit->chi2, limit));
    }
  }
  return merges;
}

mapper::Batch asBatch(Merges merges) {
  for (const auto& [gone, kept] : merges.gone_into) merges.batch.mergeLandmarks(gone, kept, merges.payloads.at(kept));
  return std::move(merges.batch);
}

// A surface of the map that is left, with what is known of it.
struct Left {
  base::LandmarkId id;
  std::shared_ptr<PlanePayload> payload;
  surfaces::Surface surface;  ///< as it is drawn
};

std::vector<Left> leftAfter(const Merges& merges, const PlaneLandmarkIndex& known, const mapper::View& view) {
  std::set<base::LandmarkId> gone;
  for (const auto& one : merges.gone_into) gone.insert(one.first);
  std::vector<Left> all;
  for (const auto& [id, surface] : known.all()) {
    if (gone.count(id) > 0) continue;
    const auto merged = merges.payloads.find(id);
    const auto& payload =
        merged != merges.payloads.end() ? *merged->second : dynamic_cast<const PlanePayload&>(*surface.payload);
    const auto shape = payload.shape({view.graph.value(surface.variable)}, view.map.key_frames);
    if (shape.surfaces.empty()) continue;
    Left left{id, std::make_shared<PlanePayload>(payload), {}};
    left.surface.plane = surface.plane;
    left.surface.parts = partsOf(shape);
    all.push_back(std::move(left));
  }
  return all;
}

// Of most of the area that the map has.
double usualRoughness(const std::vector<Left>& all) {
  std::vector<std::pair<double, double>> by_roughness;  // and their areas
  double whole = 0;
  for (const Left& left : all) {
    if (left.payload->roughness.count == 0) continue;
    double area = 0;
    for (const auto& part : left.surface.parts) area += geometry::area(geometry::Polygon3{part.outline});
    by_roughness.emplace_back(left.payload->roughness.mean(), area);
    whole += area;
  }
  std::sort(by_roughness.begin(), by_roughness.end());
  double below = 0;
  for (const auto& [roughness, area] : by_roughness) {
    below += area;
    if (below >= whole / 2) return roughness;
  }
  return 0;
}

// How often a surface must have been seen as a plane to be drawn; `rough`: how rough it is, to what is usual. Planes
// through the spines of books, the legs of chairs and heaps of things lie rougher than walls do, most of them upright
// or leaning, and the longer a log, the more chance views agree. Not at all where nothing makes up for how rough it is.
std::optional<std::size_t> sightingsToDraw(const geometry::Plane3& plane, double rough, std::size_t key_frames) {
  constexpr double kLevel = 0.95, kUpright = 0.2;                   // of the normal's height
  constexpr double kSmooth = 1.2, kRough = 1.5, kRoughLevel = 2.5;  // to what is usual
  constexpr std::size_t kLevelOnes = 2, kSmoothOnes = 3, kFewest = 2, kMost = 7, kKeyFramesForOne = 200;
  const double height = std::abs(plane.normal.z());
  const std::size_t by_length = std::min(kMost, kFewest + key_frames / kKeyFramesForOne);
  if (height > kLevel) return rough <= kRoughLevel ? std::optional(kLevelOnes) : std::nullopt;
  if (rough <= kSmooth) return height < kUpright ? std::min(kSmoothOnes, by_length) : by_length;
  return height < kUpright && rough <= kRough ? std::optional(by_length) : std::nullopt;
}

// What each surface is that is left, and whether it was seen often and well enough to be drawn.
void judgeAll(const PlaneLandmarkIndex& known, const mapper::View& view, Merges& merges) {
  const auto all = leftAfter(merges, known, view);
  if (all.empty()) return;
  std::vector<surfaces::Surface> judged;
  for (const Left& left : all) judged.push_back(left.surface);
  const auto judgements = surfaces::classify(judged, all.front().payload->groundIn(view.map.key_frames));
  const double usual = usualRoughness(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    PlanePayload& payload = *all[i].payload;
    payload.judgement = judgements[i];
    const double rough = usual > 0 ? payload.roughness.mean() / usual : 1;
    const auto needed = sightingsToDraw(all[i].surface.plane, rough, view.map.key_frames.size());
    payload.is_candidate = !needed || payload.planeSightings() < *needed;
    const auto merged = merges.payloads.find(all[i].id);
    if (merged != merges.payloads.end()) {
      merged->second = all[i].payload;
    } else {
      merges.batch.describeLandmark(all[i].id, all[i].payload);
    }
  }
}

}  // namespace

mapper::Batch mergeAlike(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                         const mapper::View& view) {
  return asBatch(findMerges(known, options, section, view, false));
}

mapper::Batch mergeAndJudge(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                            const mapper::View& view) {
  Merges merges = findMerges(known, options, section, view, true);
  judgeAll(known, view, merges);
  return asBatch(std::move(merges));
}

std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane) {
  for (const auto id : graph.factorsOf(plane))
    if (graph.factor(id).factor->kind() == landmarks::UprightFactor::kKind) return id;
  return std::nullopt;
}

}  // namespace omnimapper::plugins
