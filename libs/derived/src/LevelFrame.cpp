#include <omnimapper/derived/LevelFrame.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/Level.h>

#include <memory>
#include <utility>

namespace omnimapper::derived {

LevelFrame::LevelFrame(const map::Map& map) {
  level_from_map_.translation.setZero();
  level_from_map_.rotation.setIdentity();
  const auto* level = map.layers.find<map::Level>();
  if (!level || !level->isKnown() || level->up == Eigen::Vector3d::UnitZ()) return;
  is_of_map_ = false;
  level_from_map_.rotation = level->levelFromMap();
}

std::vector<ShapedLandmark> LevelFrame::operator()(std::vector<ShapedLandmark> landmarks) const {
  if (is_of_map_) return landmarks;
  for (auto& shaped : landmarks) {
    map::LandmarkShape& shape = shaped.shape;
    for (auto* polygons : {&shape.surfaces, &shape.holes})
      for (auto& polygon : *polygons)
        for (auto& vertex : polygon.vertices) vertex = level_from_map_ * vertex;
    for (auto& [from, to] : shape.lines) {
      from = level_from_map_ * from;
      to = level_from_map_ * to;
    }
    for (auto& point : shape.points) point = level_from_map_ * point;
    if (shape.box) {
      shape.box->middle = level_from_map_ * shape.box->middle;
      shape.box->map_from_box = level_from_map_.rotation * shape.box->map_from_box;
    }
    if (shape.mesh) {
      map::Mesh turned = *shape.mesh;
      for (auto& vertex : turned.vertices) vertex = level_from_map_ * vertex;
      shape.mesh = std::make_shared<const map::Mesh>(std::move(turned));
    }
    if (shape.normal) shape.normal = level_from_map_.rotation * *shape.normal;
  }
  return landmarks;
}

std::vector<map::StampedPose> LevelFrame::operator()(std::vector<map::StampedPose> trajectory) const {
  if (is_of_map_) return trajectory;
  for (auto& pose : trajectory)
    pose.map_from_base = geometry::toMrpt(level_from_map_ * geometry::fromMrpt(pose.map_from_base));
  return trajectory;
}

std::vector<Closure> LevelFrame::operator()(std::vector<Closure> closures) const {
  if (is_of_map_) return closures;
  for (auto& closure : closures) {
    for (auto* end : {&closure.from, &closure.to}) {
      const Eigen::Vector3d turned = level_from_map_ * Eigen::Vector3d(end->x, end->y, end->z);
      *end = {turned.x(), turned.y(), turned.z()};
    }
  }
  return closures;
}

map::Map LevelFrame::operator()(map::Map map) const {
  if (is_of_map_) return map;
  std::vector<base::KeyFrameId> ids;
  for (const auto& frame : map.key_frames) ids.push_back(frame.id);
  for (const auto id : ids) {
    auto& pose = map.key_frames.edit(id).map_from_base;
    pose = geometry::toMrpt(level_from_map_ * geometry::fromMrpt(pose));
  }
  return map;
}

}  // namespace omnimapper::derived
