#include "ObjectLandmarksPlugin.h"

#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/geometry/SymmetricEigen.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "ObjectAssociator.h"
#include "ObjectCarriers.h"
#include "ObjectMerging.h"
#include "ObjectPictures.h"
#include "ObjectPieces.h"

namespace omnimapper::plugins {

using obs::CObservationObjects;

namespace {

struct PreparedObjects : mapper::Prepared {
  std::vector<std::optional<ObjectPicture>> pictures;  // of the observation's objects, in its order
};

// [m^2] Covariance of a point that comes from that of the pose of its frame, in that frame.
Eigen::Matrix3d covarianceOfPoint(const Eigen::Vector3d& point, const geometry::Matrix6d& covariance) {
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << Eigen::Matrix3d::Identity(), -geometry::skew(point);
  return by_pose * covariance * by_pose.transpose();
}

// [m^2] Covariance of the place of an object relative to the camera, in the optical frame; none if the map does not
// know it.
std::optional<Eigen::Matrix3d> covarianceOfPlace(const ObjectGeometry& object, const LookingCamera& camera,
                                                 const mapper::WatchedPose& pose, const mapper::View& view) {
  const auto between = view.covarianceBetween(object.anchor, pose.frame);
  if (!between) return std::nullopt;
  const geometry::Se3 map_from_base = geometry::fromMrpt(pose.map_from_base);
  const geometry::Se3 frame_from_base = geometry::fromMrpt(pose.frame_from_base.begin_from_end);
  const Eigen::Vector3d in_base = geometry::inverse(map_from_base) * object.box.middle;
  const Eigen::Matrix3d base_from_frame = frame_from_base.rotation.conjugate().toRotationMatrix();
  const Eigen::Matrix3d optical_from_base =
      (camera.optical_from_map.rotation * map_from_base.rotation).toRotationMatrix();
  const Eigen::Matrix3d of_place =
      base_from_frame * covarianceOfPoint(frame_from_base * in_base, *between) * base_from_frame.transpose() +
      covarianceOfPoint(in_base, pose.frame_from_base.covariance);
  if (!of_place.allFinite()) return std::nullopt;
  return optical_from_base * of_place * optical_from_base.transpose();
}

// Of objects that were found in pieces, the largest piece gets the points of all, and the others are part of it.
void joinPieces(const std::map<base::LandmarkId, std::shared_ptr<ObjectPayload>>& payloads,
                const ObjectCarriers& carriers, const map::KeyFrames& key_frames, const ModelLimits& limits) {
  std::vector<PieceCandidate> drawn;
  for (const auto& [id, payload] : payloads) {
    if (!payload->isDrawn() || payload->model->empty()) continue;
    ObjectGeometry geometry(*payload->model, key_frames);
    const auto height = carriers.heightOf(geometry.box);
    drawn.push_back({id, std::move(geometry), height});
  }
  for (const auto& [piece, whole] : findPieces(drawn)) {
    payloads.at(piece)->part_of = whole;
    ObjectModel model = *payloads.at(whole)->model;
    for (const auto& view : payloads.at(piece)->model->views()) model = model.with(view, key_frames, limits);
    payloads.at(whole)->model = std::make_shared<const ObjectModel>(std::move(model));
  }
}

}  // namespace

ObjectLandmarksPlugin::ObjectLandmarksPlugin(const ObjectLandmarksOptions& options,
                                             const mapper::PluginContext& context)
    : LandmarkPlugin(ObjectIndex(context.section)), options_(options), map_is_held_(context.map_is_held) {}

bool ObjectLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationObjects*>(&observation) != nullptr;
}

std::unique_ptr<const mapper::Prepared> ObjectLandmarksPlugin::prepareUsing(const mrpt::obs::CObservation& observation,
                                                                            const perception::Blackboard& board) const {
  const auto image = board.find<camera::RgbdView>();
  if (!image || map_is_held_) return nullptr;
  auto prepared = std::make_unique<PreparedObjects>();
  prepared->pictures = picturesOf(dynamic_cast<const CObservationObjects&>(observation), *image);
  return prepared;
}

mapper::Batch ObjectLandmarksPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                               const mapper::View& view) {
  const auto& observation = dynamic_cast<const CObservationObjects&>(observed.observation);
  const auto* prepared = dynamic_cast<const PreparedObjects*>(observed.prepared);
  std::size_t dropped = 0;
  const auto measurements = objectMeasurements(
      observation, frame.id, prepared ? prepared->pictures : std::vector<std::optional<ObjectPicture>>(), options_,
      dropped);
  auto batch = ObjectAssociator(options_, known(), frame, view).take(measurements);
  if (dropped > 0) {
    mapper::Decision decision(frame, known().owner(), "object measurement");
    decision.reason = "the image shows more objects than max_per_image";
    decision.numbers = {{"left out", static_cast<double>(dropped)}};
    batch.log(std::move(decision));
  }
  if (!map_is_held_) describeLooks(batch);
  return batch;
}

void ObjectLandmarksPlugin::describeLooks(mapper::Batch& batch) {
  std::set<base::LandmarkId> changed;
  for (const auto& evidence : batch.evidence()) changed.insert(evidence.landmark);
  for (const auto& [id, each] : known().all()) {
    auto& object = known().at(id);
    if (!object.looks.empty() && changed.count(id) == 0) {
      auto payload = std::make_shared<ObjectPayload>(*object.payload);
      payload->evidence = object.evidence();
      batch.describeLandmark(id, std::move(payload));
    }
    object.looks.clear();
  }
}

bool ObjectLandmarksPlugin::watches(const mrpt::obs::CObservation& observation) const {
  return !map_is_held_ && camera::depthScanOf(observation) != nullptr;
}

mapper::WatchResult ObjectLandmarksPlugin::watch(const mapper::Watched& watched, const mapper::View& view) {
  const auto stamp = watched.observation.timestamp;
  const double since = base::secondsBetween(looked_at_, stamp);
  if (!watched.pose || (since >= 0 && since < options_.look_every)) return {};
  known().update(view);
  if (known().all().empty()) return {};
  looked_at_ = std::max(looked_at_, stamp);
  const auto& scan = *camera::depthScanOf(watched.observation);
  const camera::ScanDepth depth(scan);
  const geometry::Se3 map_from_optical = geometry::fromMrpt(watched.pose->map_from_base) *
                                         geometry::fromMrpt(scan.sensorPose) * geometry::sensorFromOptical();
  LookingCamera camera{depth.image(), geometry::inverse(map_from_optical)};
  camera.max_depth = options_.look_range;
  mapper::Batch batch;
  constexpr std::size_t kMostLooks = 100;
  for (const auto& [id, each] : known().all()) {
    auto& object = known().at(id);
    if (!view.areAligned(watched.pose->frame.session, id.session)) continue;
    const Sight sight = lookAt(object, camera, *watched.pose, view);
    // A key frame in which it was found has counted already.
    if (sight == Sight::unknown || object.payload->evidence.last_seen == stamp) continue;
    object.looks.emplace_back(sight, stamp);
    if (sight == Sight::absent) {
      retireIfGone(object, stamp, *watched.pose, batch);
    } else if (object.looks.size() >= kMostLooks) {
      auto payload = std::make_shared<ObjectPayload>(*object.payload);
      payload->evidence = object.evidence();
      object.looks.clear();
      batch.describeLandmark(id, std::move(payload));
    }
  }
  return {std::move(batch), {}};
}

Sight ObjectLandmarksPlugin::lookAt(const KnownObject& object, const LookingCamera& camera,
                                    const mapper::WatchedPose& pose, const mapper::View& view) const {
  constexpr double kLargest = 2;  // [m] half of an object
  const Eigen::Vector3d middle = camera.optical_from_map * Eigen::Vector3d(view.graph.value(object.variable));
  if (middle.z() < 0 || middle.norm() > 2 * camera.max_depth + kLargest) return Sight::unknown;
  const auto& geometry = object.geometry(view.map.key_frames);
  if (!isInView(geometry, camera)) return Sight::unknown;
  const Sight sight = lookFor(geometry, camera).sight();
  if (sight != Sight::absent) return sight;
  constexpr double kSigmas = 3, kMostReach = 0.4;  // [-], [m] a pose that is less certain says nothing
  const auto covariance = covarianceOfPlace(geometry, camera, pose, view);
  if (!covariance) return Sight::unknown;
  const auto axes = geometry::eigenOf<3>(*covariance);
  const Eigen::Vector3d reach = kSigmas * options_.look_inflation * axes.values.cwiseMax(0).cwiseSqrt();
  if (!(reach.maxCoeff() <= kMostReach)) return Sight::unknown;
  return mayBeBeside(geometry, camera, axes.vectors * reach.asDiagonal()) ? Sight::unknown : Sight::absent;
}

void ObjectLandmarksPlugin::retireIfGone(KnownObject& object, base::Stamp stamp, const mapper::WatchedPose& pose,
                                         mapper::Batch& batch) const {
  constexpr int kCandidateGone = 2;  // images; what was hardly seen is given up soon
  const ObjectEvidence evidence = object.evidence();
  const bool is_confirmed = object.payload->is_confirmed;
  if (!(is_confirmed ? evidence.saysGone(options_.gone_after, options_.gone_after_time)
                     : evidence.saysGone(std::min(kCandidateGone, options_.gone_after), 0)))
    return;
  auto payload = is_confirmed ? std::make_shared<ObjectPayload>(*object.payload) : object.payload->withoutModel();
  payload->evidence = evidence;
  object.looks.clear();
  batch.describeLandmark(object.id, std::move(payload));
  batch.retireLandmark(object.id);
  mapper::Decision decision;
  decision.stamp = stamp;
  decision.plugin = known().owner();
  decision.kind = is_confirmed ? "object is gone" : "candidate is gone";
  decision.from = pose.frame;
  decision.accepted = true;
  decision.reason = "looked for and not there in the images of";
  for (const auto absent : evidence.absent_at) decision.reason += " " + base::formatUnix(absent, 3);
  decision.numbers = {{"landmark", object.id.index},
                      {"seen in", evidence.seen_in},
                      {"absent in", static_cast<double>(evidence.absent_at.size())}};
  batch.log(std::move(decision));
}

mapper::Batch ObjectLandmarksPlugin::merge(const mapper::View& view) {
  return mergeObjects(known(), options_, known().owner(), view).take();
}

mapper::Batch ObjectLandmarksPlugin::finish(const mapper::View& view) {
  auto merging = mergeObjects(known(), options_, known().owner(), view);
  const ObjectCarriers carriers(known(), view);
  std::map<base::LandmarkId, std::shared_ptr<ObjectPayload>> payloads;
  for (const auto& [id, object] : known().all()) {
    if (merging.isGone(id)) continue;
    auto payload = std::make_shared<ObjectPayload>(merging.payloadOf(id));
    for (const auto& [sight, stamp] : object.looks) payload->evidence.add(sight, stamp);
    payload->model =
        std::make_shared<const ObjectModel>(withoutOthers(object, *payload->model, known(), options_, view));
    const auto box = payload->model->box(view.map.key_frames);
    payload->on = box ? carriers.under(id, *box) : std::nullopt;
    payload->part_of = box ? carriers.heldUpBy(*box) : std::nullopt;
    if (isAfloat(*payload, box, carriers)) payload->is_confirmed = false;
    payloads[id] = std::move(payload);
  }
  joinPieces(payloads, carriers, view.map.key_frames, options_.limits());
  for (auto& [id, payload] : payloads) merging.describe(id, std::move(payload));
  for (const auto& [id, object] : known().all()) known().at(id).looks.clear();
  placeGone(carriers, view, merging.batch());
  return merging.take();
}

bool ObjectLandmarksPlugin::isAfloat(const ObjectPayload& payload, const std::optional<map::Box>& box,
                                     const ObjectCarriers& carriers) const {
  return options_.on_surfaces_only && !payload.model->standsOnSurface() && !(box && carriers.bear(*box));
}

void ObjectLandmarksPlugin::placeGone(const ObjectCarriers& carriers, const mapper::View& view,
                                      mapper::Batch& batch) const {
  for (const auto& [id, landmark] : view.map.landmarks) {
    if (landmark.owner != known().owner() || landmark.state != map::Landmark::State::retired) continue;
    const auto* before = dynamic_cast<const ObjectPayload*>(landmark.payload.get());
    const auto box = before != nullptr ? before->model->box(view.map.key_frames) : std::nullopt;
    if (!box) continue;
    auto payload = std::make_shared<ObjectPayload>(*before);
    payload->on = carriers.under(id, *box);
    if (isAfloat(*payload, box, carriers)) payload->is_confirmed = false;
    batch.describeLandmark(id, std::move(payload));
  }
}

void ObjectLandmarksPlugin::registerKinds(mapper::Kinds& kinds) {
  ObjectPayload::addTo(kinds.payloads);
}

}  // namespace omnimapper::plugins
