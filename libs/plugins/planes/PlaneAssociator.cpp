#include "PlaneAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "PlaneExtent.h"
#include "PlaneMerging.h"

namespace omnimapper::plugins {

PlaneAssociator::PlaneAssociator(const PlaneLandmarksOptions& options, const std::string& section,
                                 const PlaneLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view,
                                 bool others_seek)
    : LandmarkAssociator(options, section, frame, view, mapper::Repeats::yes),
      options_(options),
      known_(known),
      form_(known.form()),
      others_seek_(others_seek),
      map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))) {
  const auto pose = view.jointCovariance({frame.pose});
  if (pose) pose_sigma_ = std::sqrt(pose->topLeftCorner<2, 2>().trace());
}

namespace {

constexpr double kSigmas = 4;  // of the pose of the base, within which landmarks are considered

LandmarkSurface::Heights heightsKnownBy(const PlaneMeasurement& measurement) {
  return measurement.is_line ? LandmarkSurface::Heights::unknown : LandmarkSurface::Heights::known;
}

}  // namespace

void PlaneAssociator::describe(const PlaneMeasurement& measurement, mapper::Decision& decision) const {
  decision.kind = measurement.is_line ? "line of a wall" : "plane";
  decision.numbers = {{measurement.is_line ? "length [m]" : "area [m^2]", measurement.size}};
}

std::vector<base::LandmarkId> PlaneAssociator::candidates(const PlaneMeasurement& measurement) {
  std::vector<base::LandmarkId> near;
  const auto points = inMap(measurement.outline_in_base);
  double range = 0;
  for (const auto& corner : measurement.outline_in_base) range = std::max(range, corner.norm());
  for (const auto& [id, surface] : known_.all()) {
    if (!mayConstrain(surface)) continue;
    const auto miss = missIfAlike(surface, measurement, points);
    // Beyond the gate, landmarks are considered if drift since their last measurement may explain the distance.
    if (!miss || (*miss > 0 && *miss > kSigmas * sigmaSince(surface.last_seen_from, range))) continue;
    near.push_back(id);
  }
  return near;
}

bool PlaneAssociator::mayConstrain(const LandmarkSurface& surface) const {
  if (others_seek_ && !view().areAligned(frame().id.session, surface.id.session)) return false;
  return !view().map_is_held || !dynamic_cast<const PlanePayload&>(*surface.payload).is_candidate;
}

std::string PlaneAssociator::whyEither(base::LandmarkId a, base::LandmarkId b) const {
  return onOnePlane(known_.at(a), known_.at(b)) ? "it spans two landmarks on one plane" : "";
}

std::optional<double> PlaneAssociator::missIfAlike(const LandmarkSurface& surface, const PlaneMeasurement& measurement,
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

double PlaneAssociator::sigmaSince(base::KeyFrameId since, double range) {
  const auto [found, is_new] = variances_since_.try_emplace(since, pose_sigma_ * pose_sigma_, 0);
  if (is_new) {
    const auto motion = view().covarianceBetween(since, frame().id);
    if (motion) found->second = {motion->topLeftCorner<3, 3>().trace(), motion->bottomRightCorner<3, 3>().trace()};
  }
  return std::sqrt(found->second.first + range * range * found->second.second);
}

std::vector<Eigen::Vector3d> PlaneAssociator::inMap(const std::vector<Eigen::Vector3d>& in_base) const {
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : in_base) points.push_back(map_from_base_ * point);
  return points;
}

graph::FactorRecord PlaneAssociator::record(const PlaneMeasurement& measurement, base::VariableId plane) const {
  graph::FactorRecord record{{frame().pose, plane}, measurement.factor, measurement.noise};
  record.loss = graph::Loss::huber(options_.loss_scale);
  record.tags.note = measurement.is_line ? "line of a laser" : "plane";
  return record;
}

std::shared_ptr<const map::LandmarkPayload> PlaneAssociator::learned(const PlaneMeasurement& measurement,
                                                                     const landmarks::LandmarkIds& known) {
  const auto& payload = payloadOf<PlanePayload>(known.landmark);
  const LandmarkSurface& surface = known_.at(known.landmark);
  const auto points = inMap(measurement.outline_in_base);
  if (determinesTilt(measurement, points, surface, payload)) {
    const auto upright = uprightFactor(view().graph, surface.variable);
    if (upright && removed_priors_.insert(*upright).second) batch().removeFactor(*upright);
  }
  return payload.with(frame().id, measurement, newsOf(measurement, points, surface, payload));
}

bool PlaneAssociator::determinesTilt(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                                     const LandmarkSurface& surface, const PlanePayload& payload) {
  constexpr double kSecondHeight = 0.4;  // [m]
  if (payload.wasSeenAsPlane()) return false;
  if (!measurement.is_line) return true;
  const auto [low, high] = heightsOf(points);
  const double before = surface.highest - surface.lowest;
  const double now = std::max(high, surface.highest) - std::min(low, surface.lowest);
  return before < kSecondHeight && now >= kSecondHeight;
}

bool PlaneAssociator::reachesOver(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points) {
  constexpr double kEdge = 0.05;  // [m]
  const plane_factors::PlaneAxes axes(surface.plane);
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
                             const LandmarkSurface& surface, const PlanePayload& payload) const {
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

double PlaneAssociator::maxGap(const LandmarkSurface& surface, const PlaneMeasurement& measurement,
                               const std::vector<Eigen::Vector3d>& points) const {
  // Surfaces that reach this high on both sides of a bookcase or a door are one wall.
  constexpr double kOverFurniture = 1.5;  // [m]
  if (measurement.is_line || surface.heights == LandmarkSurface::Heights::unknown) return options_.max_gap;
  const double high = known_.emptyPayload().groundIn(view().map.key_frames) + kOverFurniture;
  const bool is_wall = surface.highest > high && heightsOf(points).second > high;
  return is_wall ? options_.max_gap : options_.max_plane_gap;
}

void PlaneAssociator::addNew(const PlaneMeasurement& measurement, mapper::Decision decision) {
  const auto points = inMap(measurement.outline_in_base);
  if (LandmarkSurface* same = freshMatch(measurement, points)) {
    decision.accepted = true;
    decision.reason = "another measurement of a new landmark in the same observation";
    batch().log(std::move(decision));
    return addToFresh(measurement, points, *same);
  }
  if (!(measurement.size >= (measurement.is_line ? options_.min_length : options_.min_area))) {
    decision.reason = "too small for a new landmark: " + decision.reason;
    return batch().log(std::move(decision));
  }
  LandmarkSurface surface;
  surface.plane = map_from_base_ * measurement.plane_in_base;
  surface.hull = hullOn(plane_factors::PlaneAxes(surface.plane), points);
  std::tie(surface.lowest, surface.highest) = heightsOf(points);
  surface.heights = heightsKnownBy(measurement);
  const auto ids = addLandmark(measurement, std::move(decision),
                               {"plane", form_.variable(), form_.value(surface.plane, points),
                                known_.emptyPayload().with(frame().id, measurement, {true, true})});
  surface.id = ids.landmark;
  surface.variable = ids.variable;
  if (measurement.is_line && form_.mayTilt()) holdUpright(surface);
  fresh_.push_back(std::move(surface));
}

void PlaneAssociator::holdUpright(const LandmarkSurface& surface) {
  graph::FactorRecord upright{
      {surface.variable},
      std::make_shared<plane_factors::UprightFactor>(),
      graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, options_.upright_sigma))};
  upright.tags.owner = section();
  upright.tags.landmark = surface.id;
  upright.tags.note = "upright";
  batch().addFactor(upright);
}

void PlaneAssociator::addToFresh(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                                 LandmarkSurface& fresh) {
  addFactor(measurement, {fresh.id, fresh.variable});
  addEvidence(fresh.id, payloadOf<PlanePayload>(fresh.id).with(frame().id, measurement, {true, true}));
  const plane_factors::PlaneAxes axes(fresh.plane);
  for (const auto& point : points) fresh.hull.push_back(axes.onto(point));
  fresh.hull = geometry::convexHull(std::move(fresh.hull));
}

LandmarkSurface* PlaneAssociator::freshMatch(const PlaneMeasurement& measurement,
                                             const std::vector<Eigen::Vector3d>& points) {
  constexpr double kTurn = 0.05, kOff = 0.05;  // [rad], [m]
  const Eigen::Vector3d normal = map_from_base_.rotation * measurement.plane_in_base.normal;
  for (LandmarkSurface& fresh : fresh_) {
    const geometry::Plane3& plane = fresh.plane;
    const bool off = std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
      return std::abs(signedDistance(plane, point)) > kOff;
    });
    if (!off && plane.normal.cross(normal).norm() < kTurn && plane.normal.dot(normal) > 0 &&
        gapBetween(fresh, points, heightsKnownBy(measurement)) <= maxGap(fresh, measurement, points))
      return &fresh;
  }
  return nullptr;
}

}  // namespace omnimapper::plugins
