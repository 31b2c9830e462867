#include "ObjectCarriers.h"

#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::plugins {

namespace {

constexpr double kLevelCosine = 0.985;  // 10 deg
constexpr double kMostGapBelow = 0.05;  // [m]
constexpr double kMostBeside = 0.5;     // [m] beside what was seen of a surface: things on it hide the rest

// The upper or lower face of a box that is nearest to level.
geometry::Polygon3 topOf(const map::Box& box) {
  geometry::Polygon3 top;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    top.vertices.push_back(box.middle + box.map_from_box * Eigen::Vector3d(x, y, 0.5).cwiseProduct(box.size));
  return top;
}

// [m] How far a point in the plane of the outline is from its nearest vertex; 0 if it is inside.
double distanceBeside(const geometry::Polygon3& outline, const Eigen::Vector3d& point) {
  if (geometry::contains(outline, point)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& vertex : outline.vertices) least = std::min(least, (vertex - point).norm());
  return least;
}

}  // namespace

ObjectCarriers::ObjectCarriers(const ObjectIndex& objects, const mapper::State& state) {
  const auto* level = state.map.layers.find<map::Level>();
  up_ = level != nullptr ? level->up : Eigen::Vector3d::UnitZ();
  const auto isLevel = [&](const geometry::Polygon3& outline) {
    const Eigen::Vector3d normal = geometry::areaVector(outline);
    return std::abs(normal.dot(up_)) > kLevelCosine * normal.norm() && normal.norm() > 0;
  };
  const auto deleted = map::deletedLandmarks(state.map);
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state != map::Landmark::State::active || landmark.owner == objects.owner() || deleted.count(id) > 0)
      continue;
    const auto shape = mapper::shapeOf(landmark, state);
    Surface surface{id, {}, false, shape.label == "floor"};
    for (const auto& outline : shape.surfaces)
      if (!shape.is_candidate && isLevel(outline)) surface.outlines.push_back(outline);
    if (!surface.outlines.empty()) surfaces_.push_back(std::move(surface));
  }
  for (const auto& [id, object] : objects.all()) {
    const auto top = topOf(object.geometry(state.map.key_frames).box);
    if (object.payload->isDrawn() && isLevel(top) && deleted.count(id) == 0)
      surfaces_.push_back({id, {top}, true, false});
  }
}

std::optional<base::LandmarkId> ObjectCarriers::under(base::LandmarkId object, const map::Box& box) const {
  const Eigen::Vector3d foot = box.middle - 0.5 * box.size.z() * (box.map_from_box * Eigen::Vector3d::UnitZ());
  std::optional<base::LandmarkId> nearest;
  double least = kMostBeside;
  for (const auto& surface : surfaces_) {
    if (surface.landmark == object) continue;
    for (const auto& outline : surface.outlines) {
      const Eigen::Vector3d normal = geometry::areaVector(outline).normalized();
      const double gap = std::abs(normal.dot(foot - outline.vertices.front()));
      if (gap > kMostGapBelow) continue;
      const double beside =
          surface.is_object && !geometry::contains(outline, foot) ? kMostBeside : gap + distanceBeside(outline, foot);
      if (beside >= least) continue;
      least = beside;
      nearest = surface.landmark;
    }
  }
  return nearest;
}

std::optional<double> ObjectCarriers::heightOf(const map::Box& box) const {
  const Eigen::Vector3d foot = box.middle - 0.5 * box.size.z() * (box.map_from_box * Eigen::Vector3d::UnitZ());
  std::optional<double> least;
  for (const auto& surface : surfaces_) {
    if (surface.is_object) continue;
    for (const auto& outline : surface.outlines) {
      const double height = up_.dot(foot - outline.vertices.front());
      const Eigen::Vector3d below = foot - height * up_;
      if (height < -kMostGapBelow || (least && height >= *least) || distanceBeside(outline, below) >= kMostBeside)
        continue;
      least = height <= kMostGapBelow ? 0 : height;
    }
  }
  return least;
}

bool ObjectCarriers::bear(const map::Box& box) const {
  constexpr double kNearly = 0.1;  // [m]
  const Eigen::Vector3d foot = box.middle - 0.5 * box.size.z() * (box.map_from_box * Eigen::Vector3d::UnitZ());
  return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Surface& surface) {
    if (surface.is_object || surface.is_floor) return false;
    return std::any_of(surface.outlines.begin(), surface.outlines.end(), [&](const geometry::Polygon3& outline) {
      return std::abs(up_.dot(foot - outline.vertices.front())) <= kMostGapBelow &&
             distanceBeside(outline, foot) <= kNearly;
    });
  });
}

std::optional<base::LandmarkId> ObjectCarriers::heldUpBy(const map::Box& box) const {
  constexpr double kMostGapAbove = 0.06, kLeastHeight = 0.25;  // [m]
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const auto& corner : box.corners()) {
    bottom = std::min(bottom, up_.dot(corner));
    top = std::max(top, up_.dot(corner));
  }
  for (const auto& surface : surfaces_) {
    if (surface.is_object) continue;
    for (const auto& outline : surface.outlines) {
      const double height = up_.dot(outline.vertices.front());
      if (std::abs(height - top) > kMostGapAbove || height - bottom < kLeastHeight) continue;
      const Eigen::Vector3d below = box.middle + (height - up_.dot(box.middle)) * up_;
      if (distanceBeside(outline, below) < kMostBeside) return surface.landmark;
    }
  }
  return std::nullopt;
}

}  // namespace omnimapper::plugins
