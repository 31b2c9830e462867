#include "KnownObject.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>

namespace omnimapper::plugins {

namespace {

bool isSamePose(const geometry::Se3& a, const geometry::Se3& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

}  // namespace

const ObjectView& nearestView(const ObjectModel& model) {
  return *std::min_element(model.views().begin(), model.views().end(),
                           [](const auto& a, const auto& b) { return a.distance < b.distance; });
}

ObjectGeometry::ObjectGeometry(const ObjectModel& model, const map::KeyFrames& key_frames)
    : points(model.pointsInMap(key_frames)),
      grid(kNear, points),
      box(model.box(key_frames).value_or(map::Box())),
      up(model.upInMap(key_frames)),
      foot(model.footInMap(key_frames)) {
  for (const auto& point : points) bounds.extend(point);
  if (!model.views().empty()) anchor = nearestView(model).frame;
}

void KnownObject::refresh(const map::Landmark& landmark, const mapper::View& view) {
  KnownLandmark::refresh(landmark, view);
  std::vector<geometry::Se3> poses;
  auto current = std::dynamic_pointer_cast<const ObjectPayload>(landmark.payload);
  if (!current) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "landmark " + toString(landmark.id) + " of [" + landmark.owner +
                          "] is no object: another plugin had this section; give the plugin of objects another one");
  }
  for (const auto& each : current->model->views())
    poses.push_back(geometry::fromMrpt(view.map.key_frames.at(each.frame).map_from_base));
  const bool same = payload && payload->model == current->model &&
                    std::equal(poses.begin(), poses.end(), poses_.begin(), poses_.end(), isSamePose);
  if (!same) geometry_ = nullptr;
  payload = std::move(current);
  poses_ = std::move(poses);
}

ObjectEvidence KnownObject::evidence() const {
  ObjectEvidence evidence = payload->evidence;
  for (const auto& [sight, stamp] : looks) evidence.add(sight, stamp);
  return evidence;
}

const ObjectGeometry& KnownObject::geometry(const map::KeyFrames& key_frames) const {
  if (!geometry_) geometry_ = std::make_shared<const ObjectGeometry>(*payload->model, key_frames);
  return *geometry_;
}

}  // namespace omnimapper::plugins
