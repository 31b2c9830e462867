#include "PlaneAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/landmarks/InterSessionHypothesis.h>
#include <omnimapper/landmarks/PlaneFactors.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "PlaneExtent.h"
#include "PlaneMerging.h"

namespace omnimapper::plugins {

using geometry::Plane3;

PlaneAssociator::PlaneAssociator(const PlaneLandmarksOptions& options, const mapper::PluginContext& context,
                                 const PlaneLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view,
                                 bool others_seek)
    : options_(options),
      context_(context),
      known_(known),
      form_(known.form()),
      frame_(frame),
      view_(view),
      others_seek_(others_seek),
      map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))) {
  const auto pose = view.jointCovariance({frame.pose});
  if (pose) pose_sigma_ = std::sqrt(pose->topLeftCorner<2, 2>().trace());
}

namespace {

constexpr double kSigmas = 4;  // of the pose of the base, within which landmarks are considered

PlaneLandmarkIndex::Heights heightsKnownBy(const PlaneMeasurement& measurement) {
  return measurement.is_line ? PlaneLandmarkIndex::Heights::unknown : PlaneLandmarkIndex::Heights::known;
}

}  // namespace

mapper::Batch PlaneAssociator::take(const std::vector<PlaneMeasurement>& all) {
  std::vector<PlaneMeasurement> measurements;
  for (const auto& measurement : all) {
    if (measurement.why_useless.empty()) {
      measurements.push_back(measurement);
    } else {
      logUseless(measurement);
    }
  }
  const auto pairings = pairingsOf(measurements);
  const auto found = mapper::associate(measurements.size(), pairings, view_, options_, mapper::Repeats::yes);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto& match = found.matches[i];
    mapper::Decision decision = decisionOf(measurements[i]);
    found.describe(i, decision);
    if (match.pairing) decision.numbers.emplace_back("landmark", pairings[*match.pairing].landmark.index);
    const bool spans_two = spansTwo(match, pairings);
    if (spans_two) decision.reason = "matched: it spans two landmarks on one plane";
    if (match.kind == mapper::Match::Kind::matched || spans_two) {
      decision.accepted = true;
      addToKnown(measurements[i], pairings[*match.pairing], std::move(decision));
    } else if (match.kind == mapper::Match::Kind::unknown) {
      addNew(measurements[i], std::move(decision));
    } else {
      batch_.log(std::move(decision));
    }
  }
  return std::move(batch_);
}

std::vector<mapper::Pairing> PlaneAssociator::pairingsOf(const std::vector<PlaneMeasurement>& measurements) {
  std::vector<mapper::Pairing> pairings;
  // A run that only localizes does not update landmarks, so candidates, which may be noise, must not constrain a pose.
  const auto isOf = [&](const PlaneLandmarkIndex::Surface& surface) {
    if (others_seek_ && !view_.areAligned(frame_.id.session, surface.id.session)) return false;
    return !view_.map_is_held || !dynamic_cast<const PlanePayload&>(*surface.payload).is_candidate;
  };
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto points = inMap(measurements[i].outline_in_base);
    double range = 0;
    for (const auto& corner : measurements[i].outline_in_base) range = std::max(range, corner.norm());
    for (const auto& [id, surface] : known_.all()) {
      if (!isOf(surface)) continue;
      const auto miss = missIfAlike(surface, measurements[i], points);
      // Beyond the gate, landmarks are considered if drift since their last measurement may explain the distance.
      if (!miss || (*miss > 0 && *miss > kSigmas * sigmaSince(surface.last_seen_from, range))) continue;
      pairings.push_back({i, surface.id, record(measurements[i], surface.variable, surface.id)});
    }
  }
  return pairings;
}

bool PlaneAssociator::spansTwo(const mapper::Match& match, const std::vector<mapper::Pairing>& pairings) const {
  if (match.kind != mapper::Match::Kind::ambiguous) return false;
  const auto& all = known_.all();
  return onOnePlane(all.at(pairings[*match.pairing].landmark), all.at(*match.rival));
}

std::optional<double> PlaneAssociator::missIfAlike(const PlaneLandmarkIndex::Surface& surface,
                                                   const PlaneMeasurement& measurement,
                                                   const std::vector<Eigen::Vector3d>& points) const {
  constexpr double kAlong = 0.8, kFarthest = 0.5;  // cosine of the turn, [m]
  const Eigen::Vector3d normal = map_from_base_.rotation * measurement.plane_in_base.normal;
  if (surface.plane.normal.dot(normal) < kAlong) return std::nullopt;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points) middle += point / static_cast<double>(points.size());
  const double off = std::abs(signedDistance(surface.plane, middle)) - kFarthest;
  if (off > kSigmas * pose_sigma_) return std::nullopt;
  const double max_gap = maxGap(surface, measurement, points), farthest = max_gap + kSigmas * pose_sigma_;
  if (gapAtLeast(surface, points, middle) > farthest) return std::nullopt;
  const double gap = gapBetween(surface, points, heightsKnownBy(measurement)) - max_gap;
  if (gap > kSigmas * pose_sigma_) return std::nullopt;
  return std::max(off, gap);
}

double PlaneAssociator::sigmaSince(base::KeyFrameId frame, double range) {
  const auto [found, is_new] = variances_since_.try_emplace(frame, pose_sigma_ * pose_sigma_, 0);
  if (is_new) {
    const auto motion = view_.covarianceBetween(frame, frame_.id);
    if (motion) found->second = {motion->topLeftCorner<3, 3>().trace(), motion->bottomRightCorner<3, 3>().trace()};
  }
  return std::sqrt(found->second.first + range * range * found->second.second);
}

std::vector<Eigen::Vector3d> PlaneAssociator::inMap(const std::vector<Eigen::Vector3d>& in_base) const {
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : in_base) points.push_back(map_from_base_ * point);
  return points;
}

graph::FactorRecord PlaneAssociator::record(const PlaneMeasurement& measurement, base::VariableId plane,
                                            base::LandmarkId landmark) const {
  graph::FactorRecord record{{frame_.pose, plane}, measurement.factor, measurement.noise};
  record.loss = graph::Loss::huber(options_.loss_scale);
  record.tags.owner = context_.section;
  record.tags.landmark = landmark;
  record.tags.note = measurement.is_line ? "line of a laser" : "plane";
  return record;
}

mapper::Decision PlaneAssociator::decisionOf(const PlaneMeasurement& measurement) const {
  mapper::Decision decision;
  decision.stamp = frame_.stamp;
  decision.plugin = context_.section;
  decision.kind = measurement.is_line ? "line of a wall" : "plane";
  decision.from = frame_.id;
  decision.numbers = {{measurement.is_line ? "length [m]" : "area [m^2]", measurement.size}};
  return decision;
}

void PlaneAssociator::addToKnown(const PlaneMeasurement& measurement, const mapper::Pairing& pairing,
                                 mapper::Decision decision) {
  const base::LandmarkId id = pairing.landmark;
  if (landmarks::addInterSessionHypothesis(view_, frame_.id, pairing, decision, batch_)) return;
  batch_.log(std::move(decision));
  batch_.addFactor(pairing.record);
  // One observation may measure a landmark twice: the second measurement continues from the payload of the first.
  auto& payload = payloads_[id];
  if (!payload) payload = std::dynamic_pointer_cast<const PlanePayload>(view_.map.landmark(id).payload);
  const PlaneLandmarkIndex::Surface& surface = known_.all().at(id);
  const auto points = inMap(measurement.outline_in_base);
  if (determinesTilt(measurement, points, surface, *payload)) {
    const auto upright = uprightFactor(view_.graph, surface.variable);
    if (upright && removed_priors_.insert(*upright).second) batch_.removeFactor(*upright);
  }
  payload = payload->with(frame_.id, measurement, newsOf(measurement, points, surface, *payload));
  batch_.addEvidence(id, payload);
}

bool PlaneAssociator::determinesTilt(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                                     const PlaneLandmarkIndex::Surface& surface, const PlanePayload& payload) {
  constexpr double kSecondHeight = 0.4;  // [m]
  if (payload.wasSeenAsPlane()) return false;
  if (!measurement.is_line) return true;
  const auto [low, high] = heightsOf(points);
  const double before = surface.highest - surface.lowest;
  const double now = std::max(high, surface.highest) - std::min(low, surface.lowest);
  return before < kSecondHeight && now >= kSecondHeight;
}

bool PlaneAssociator::reachesOver(const PlaneLandmarkIndex::Surface& surface,
                                  const std::vector<Eigen::Vector3d>& points) {
  constexpr double kEdge = 0.05;  // [m]
  const landmarks::PlaneAxes axes(surface.plane);
  return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return geometry::distance(surface.hull, {axes.onto(point)}) > kEdge;
  });
}

namespace {

// Whether a part of a surface covers more cells that were not yet seen than the poor repeatability of edges explains.
bool showsMore(const surfaces::FlatPart& part, const geometry::Plane3& plane, const surfaces::CellGrid& seen) {
  constexpr double kBay = 0.02, kEdge = 0.004;  // [m^2], [m] repeatability of edges
  const auto& points = part.outline;
  if (!(extentOf(points) < kLargestCounted)) return false;
  double around = 0;
  for (std::size_t i = 0; i < points.size(); ++i) around += (points[i] - points[(i + 1) % points.size()]).norm();
  auto cells = surfaces::CellGrid::around(plane, points, kSeenCell);
  cells.fill(points, part.holes);
  double unseen = 0;
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      if (!cells.isSet({column, row})) continue;
      const auto known = seen.cellAt(cells.middleOf({column, row}));
      if (!known || !seen.isSet(*known)) unseen += cells.areaOfCell();
    }
  }
  return unseen > kBay + kEdge * around;
}

}  // namespace

News PlaneAssociator::newsOf(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                             const PlaneLandmarkIndex::Surface& surface, const PlanePayload& payload) const {
  News news{reachesOver(surface, points), false};
  if (payload.boundary != PlanePayload::Boundary::seen || measurement.is_line) return news;
  const auto partInMap = [&](const std::vector<Eigen::Vector3d>& outline,
                             const std::vector<std::vector<Eigen::Vector3d>>& holes) {
    surfaces::FlatPart part{inMap(outline), {}};
    for (const auto& hole : holes) part.holes.push_back(inMap(hole));
    return part;
  };
  const auto whole = partInMap(measurement.outline_in_base, measurement.holes_in_base);
  news.of_extent = news.of_extent || showsMore(whole, surface.plane, surface.seen);
  news.of_well_seen = measurement.is_all_well_seen && showsMore(whole, surface.plane, surface.well_seen);
  for (const auto& part : measurement.well_seen_in_base) {
    news.of_well_seen =
        news.of_well_seen || showsMore(partInMap(part.outline, part.holes), surface.plane, surface.well_seen);
  }
  return news;
}

double PlaneAssociator::maxGap(const PlaneLandmarkIndex::Surface& surface, const PlaneMeasurement& measurement,
                               const std::vector<Eigen::Vector3d>& points) const {
  // Surfaces that reach this high on both sides of a bookcase or a door are one wall.
  constexpr double kOverFurniture = 1.5;  // [m]
  if (measurement.is_line || surface.heights == PlaneLandmarkIndex::Heights::unknown) return options_.max_gap;
  const double high = known_.emptyPayload().groundIn(view_.map.key_frames) + kOverFurniture;
  const bool is_wall = surface.highest > high && heightsOf(points).second > high;
  return is_wall ? options_.max_gap : options_.max_plane_gap;
}

void PlaneAssociator::logUseless(const PlaneMeasurement& measurement) {
  mapper::Decision decision = decisionOf(measurement);
  decision.reason = measurement.why_useless;
  batch_.log(std::move(decision));
}

void PlaneAssociator::addNew(const PlaneMeasurement& measurement, mapper::Decision decision) {
  if (view_.map_is_held) {
    decision.reason = "not in the map: " + decision.reason;
    return batch_.log(std::move(decision));
  }
  const Plane3 plane = map_from_base_ * measurement.plane_in_base;
  const auto points = inMap(measurement.outline_in_base);
  if (Fresh* same = freshMatch(measurement, points)) {
    decision.accepted = true;
    decision.reason = "another measurement of a new landmark in the same observation";
    batch_.log(std::move(decision));
    batch_.addFactor(record(measurement, same->surface.variable, same->surface.id));
    same->payload = same->payload->with(frame_.id, measurement, {true, true});
    batch_.addEvidence(same->surface.id, same->payload);
    const landmarks::PlaneAxes axes(same->surface.plane);
    for (const auto& point : points) same->surface.hull.push_back(axes.onto(point));
    same->surface.hull = geometry::convexHull(std::move(same->surface.hull));
    return;
  }
  const bool large = measurement.size >= (measurement.is_line ? options_.min_length : options_.min_area);
  decision.accepted = large;
  decision.reason = (large ? "new: " : "too small for a new landmark: ") + decision.reason;
  batch_.log(std::move(decision));
  if (!large) return;
  const auto variable = batch_.addVariable(form_.variable(), form_.value(plane, points));
  const auto payload = known_.emptyPayload().with(frame_.id, measurement, {true, true});
  const auto landmark = batch_.addLandmark("plane", {variable}, payload);
  batch_.addFactor(record(measurement, variable, landmark));
  if (measurement.is_line && form_.mayTilt()) {
    graph::FactorRecord upright{
        {variable},
        std::make_shared<landmarks::UprightFactor>(),
        graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, options_.upright_sigma))};
    upright.tags.owner = context_.section;
    upright.tags.landmark = landmark;
    upright.tags.note = "upright";
    batch_.addFactor(upright);
  }
  Fresh fresh;
  fresh.surface.id = landmark;
  fresh.surface.variable = variable;
  fresh.surface.plane = plane;
  fresh.surface.hull = hullOn(landmarks::PlaneAxes(plane), points);
  std::tie(fresh.surface.lowest, fresh.surface.highest) = heightsOf(points);
  fresh.surface.heights = heightsKnownBy(measurement);
  fresh.payload = payload;
  fresh_.push_back(std::move(fresh));
}

PlaneAssociator::Fresh* PlaneAssociator::freshMatch(const PlaneMeasurement& measurement,
                                                    const std::vector<Eigen::Vector3d>& points) {
  constexpr double kTurn = 0.05, kOff = 0.05;  // [rad], [m]
  const Eigen::Vector3d normal = map_from_base_.rotation * measurement.plane_in_base.normal;
  for (Fresh& fresh : fresh_) {
    const Plane3& plane = fresh.surface.plane;
    const bool off = std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
      return std::abs(signedDistance(plane, point)) > kOff;
    });
    if (!off && plane.normal.cross(normal).norm() < kTurn && plane.normal.dot(normal) > 0 &&
        gapBetween(fresh.surface, points, heightsKnownBy(measurement)) <= maxGap(fresh.surface, measurement, points))
      return &fresh;
  }
  return nullptr;
}

}  // namespace omnimapper::plugins
