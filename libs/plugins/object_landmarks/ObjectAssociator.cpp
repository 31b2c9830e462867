#include "ObjectAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>

namespace omnimapper::plugins {

namespace {

// Whether no side of one box is more than 1.5 times that of the other, in the order of their lengths.
bool areAlike(Eigen::Vector3d a, Eigen::Vector3d b) {
  constexpr double kMost = 1.5, kSlack = 0.02;  // [-], [m]
  std::sort(a.data(), a.data() + 3);
  std::sort(b.data(), b.data() + 3);
  return (a.array() <= kMost * b.array() + kSlack).all() && (b.array() <= kMost * a.array() + kSlack).all();
}

}  // namespace

ObjectAssociator::ObjectAssociator(const ObjectLandmarksOptions& options, const ObjectIndex& known,
                                   const map::KeyFrame& frame, const mapper::View& view)
    : LandmarkAssociator(options, known.owner(), frame, view),
      options_(options),
      known_(known),
      map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))) {
  for (const auto& [id, object] : known.all()) {
    by_variable_[object.variable] = &object;
    unconfirmed_ += !object.payload->is_confirmed;
  }
}

void ObjectAssociator::describe(const ObjectMeasurement& measurement, mapper::Decision& decision) const {
  decision.kind = "object measurement";
  decision.numbers = {{"distance [m]", measurement.view.distance},
                      {"points", static_cast<double>(measurement.view.points.size())}};
}

ObjectPoints ObjectAssociator::inMap(const ObjectMeasurement& measurement) const {
  const Eigen::Matrix3f turn = map_from_base_.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f move = map_from_base_.translation.cast<float>();
  ObjectPoints points;
  for (const auto& point : measurement.view.points) points.emplace_back(turn * point + move);
  return points;
}

double ObjectAssociator::overlapOf(const ObjectPoints& points, const PointGrid& grid, const KnownObject& object) const {
  const auto& there = object.geometry(view().map.key_frames);
  return std::max(shareNear(there.grid, points), shareNear(grid, there.points));
}

std::vector<base::LandmarkId> ObjectAssociator::candidates(const ObjectMeasurement& measurement) {
  constexpr double kMostGap = 0.3;  // [m] between boxes of like size
  const ObjectPoints points = inMap(measurement);
  const PointGrid grid(ObjectGeometry::kNear, points);
  Eigen::AlignedBox3f bounds;
  for (const auto& point : points) bounds.extend(point);
  constexpr auto kNear = static_cast<float>(ObjectGeometry::kNear);
  const Eigen::AlignedBox3f around(bounds.min().array() - kNear, bounds.max().array() + kNear);
  const Eigen::Vector3d middle = map_from_base_ * measurement.middle;
  std::vector<base::LandmarkId> overlapping, alike;
  for (const auto& [id, object] : known_.all()) {
    const double gap = (view().graph.value(object.variable) - middle).norm();
    if (gap > 3 || given_up_.count(id) > 0) continue;  // no object is larger
    const auto& there = object.geometry(view().map.key_frames);
    if (there.bounds.intersects(around) && overlapOf(points, grid, object) >= options_.min_overlap) {
      overlapping.push_back(id);
    } else if (gap <= std::min(kMostGap, measurement.size.norm()) && areAlike(there.box.size, measurement.size)) {
      alike.push_back(id);
    }
  }
  return overlapping.empty() ? alike : overlapping;
}

graph::FactorRecord ObjectAssociator::record(const ObjectMeasurement& measurement, base::VariableId middle) const {
  Eigen::Matrix3d covariance = measurement.covariance;
  if (const auto found = by_variable_.find(middle); found != by_variable_.end()) {
    // The middle of the map's object is that of the part which was seen before.
    const auto& box = found->second->geometry(view().map.key_frames).box;
    const Eigen::Matrix3d base_from_box = (map_from_base_.rotation.conjugate() * box.map_from_box).toRotationMatrix();
    covariance += covarianceOfPart(base_from_box, box.size, options_.size_share);
  }
  graph::FactorRecord record{{frame().pose, middle},
                             std::make_shared<graph::PointFactor3>(measurement.middle),
                             graph::SquareRootInformation::fromCovariance(covariance)};
  record.loss = graph::Loss::huber(3);
  record.tags.note = "object";
  return record;
}

std::shared_ptr<ObjectPayload> ObjectAssociator::firstPayload(const ObjectMeasurement& measurement) const {
  auto payload = std::make_shared<ObjectPayload>();
  payload->model = std::make_shared<const ObjectModel>(
      ObjectModel().with(measurement.view, view().map.key_frames, options_.limits()));
  payload->evidence.add(Sight::seen, frame().stamp);
  payload->measured_in = 1;
  payload->is_confirmed = options_.confirm_after <= 1;
  if (!measurement.class_label.empty()) payload->classes[measurement.class_label] = measurement.score;
  payload->seen_by[measurement.sensor_label] = 1;
  payload->picture = measurement.picture;
  return payload;
}

std::shared_ptr<const map::LandmarkPayload> ObjectAssociator::learned(const ObjectMeasurement& measurement,
                                                                      const landmarks::LandmarkIds& known) {
  if (view().map_is_held) return nullptr;
  const auto& before = payloadOf<ObjectPayload>(known.landmark);
  auto payload = before.with(*firstPayload(measurement), view().map.key_frames, options_.limits());
  const auto& there = known_.at(known.landmark).geometry(view().map.key_frames);
  const ObjectPoints points = inMap(measurement);
  if (shareNear(there.grid, points) < options_.min_overlap || isBlob(points, known.landmark)) {
    payload->model = before.model;  // only the evidence is taken
    payload->picture = before.picture;
  }
  for (const auto& [sight, stamp] : known_.at(known.landmark).looks) payload->evidence.add(sight, stamp);
  payload->is_confirmed =
      payload->is_confirmed || payload->measured_in >= static_cast<std::uint32_t>(options_.confirm_after);
  return payload;
}

bool ObjectAssociator::isBlob(const ObjectPoints& points, base::LandmarkId taken_for) const {
  const PointGrid grid(ObjectGeometry::kNear, points);
  return std::any_of(known_.all().begin(), known_.all().end(), [&](const auto& known) {
    const auto& [id, other] = known;
    if (id == taken_for || !other.payload->is_confirmed) return false;
    const auto& there = other.geometry(view().map.key_frames);
    return shareNear(grid, there.points) >= options_.merge_overlap;
  });
}

void ObjectAssociator::makeRoom() {
  const KnownObject* oldest = nullptr;
  for (const auto& [id, object] : known_.all()) {
    if (object.payload->is_confirmed || given_up_.count(id) > 0 || met().count(id) > 0) continue;
    if (oldest == nullptr || object.payload->evidence.last_seen < oldest->payload->evidence.last_seen) oldest = &object;
  }
  if (oldest == nullptr) return;
  given_up_.insert(oldest->id);
  batch().describeLandmark(oldest->id, oldest->payload->withoutModel());
  batch().retireLandmark(oldest->id);
  --unconfirmed_;
}

void ObjectAssociator::addNew(const ObjectMeasurement& measurement, mapper::Decision decision) {
  if (unconfirmed_ >= static_cast<std::size_t>(options_.max_candidates)) makeRoom();
  if (unconfirmed_ >= static_cast<std::size_t>(options_.max_candidates)) {
    decision.accepted = false;
    decision.reason = "there are " + std::to_string(unconfirmed_) + " objects that have not been confirmed";
    return batch().log(std::move(decision));
  }
  auto payload = firstPayload(measurement);
  unconfirmed_ += !payload->is_confirmed;
  addLandmark(measurement, std::move(decision),
              {"object", graph::point3(), map_from_base_ * measurement.middle, std::move(payload)});
}

}  // namespace omnimapper::plugins
