#include "roomsOfMap.h"

#include <omnimapper/building/Continuation.h>
#include <omnimapper/building/DoorSigns.h>
#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/building/RoomKinds.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <limits>
#include <map>

namespace omnimapper::plugins {

namespace {

geometry::Se2 poseOf(const map::KeyFrame& frame) {
  return {frame.map_from_base.x(), frame.map_from_base.y(), frame.map_from_base.yaw()};
}

/// Whether a sign has the same text as others at other doors.
bool isRepeated(const map::LandmarkShape& sign) {
  return std::any_of(sign.properties.begin(), sign.properties.end(),
                     [](const map::Property& property) { return property.name == "repeated_elsewhere"; });
}

std::vector<building::DoorSign> signsOf(const std::vector<derived::ShapedLandmark>& landmarks) {
  std::vector<building::DoorSign> signs;
  for (const auto& [landmark, shape, moved] : landmarks) {
    const bool is_sign = shape.label == "sign" && !shape.caption.empty() && shape.normal && !shape.points.empty();
    if (!is_sign || moved) continue;
    const Eigen::Vector2d facing = shape.normal->head<2>();
    if (!(facing.norm() > 0.5)) continue;
    signs.push_back({toString(landmark->id), shape.caption, derived::referencePoint(shape).head<2>(),
                     facing.normalized(), isRepeated(shape)});
  }
  return signs;
}

/// What was seen in each room, and whether anything but walls was seen.
struct Contents {
  std::map<int, building::RoomContents> by_room;
  bool sees_things = false;
};

Contents contentsOf(const std::vector<derived::ShapedLandmark>& landmarks, const building::Storey& storey) {
  Contents contents;
  for (const auto& shaped : landmarks) {
    if (shaped.moved || shaped.isFaint() || !shaped.isSomewhere()) continue;
    const auto& features = building::kindFeatures();
    const bool counts = std::any_of(features.begin(), features.end(),
                                    [&](const auto& feature) { return feature.name == shaped.shape.label; });
    if (!counts) continue;
    contents.sees_things = true;
    const Eigen::Vector2d at = derived::referencePoint(shaped.shape).head<2>();
    std::optional<Eigen::Vector2d> free_side;
    if (shaped.shape.normal) free_side = shaped.shape.normal->head<2>();
    if (const auto* room = building::roomOfThing(storey, at, free_side))
      ++contents.by_room[room->id][shaped.shape.label];
  }
  return contents;
}

// The key frame nearest to the middle of a room, those in the room first.
std::optional<building::Anchor> anchorOf(const building::Room& room, const map::KeyFrames& key_frames) {
  constexpr double kElsewhere = 1000;  // [m]
  std::optional<building::Anchor> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& frame : key_frames) {
    const geometry::Se2 pose = poseOf(frame);
    double distance = (pose.translation() - room.centre).norm();
    if (distance < least && !building::contains(room, pose.translation())) distance += kElsewhere;
    if (distance >= least) continue;
    least = distance;
    nearest = building::Anchor{frame.id, pose};
  }
  return nearest;
}

building::Storey asItIsNow(const building::Storey& earlier, const map::KeyFrames& key_frames) {
  return building::movedWith(earlier, [&](base::KeyFrameId id) -> std::optional<geometry::Se2> {
    const auto* frame = key_frames.find(id);
    if (!frame) return std::nullopt;
    return poseOf(*frame);
  });
}

// Applies edits that were made in this map or in an earlier one of the place.
void takeOver(const building::RoomEdits& edits, const grid::GridMap& grid,
              const std::map<std::string, Eigen::Vector2d>& signs, building::Segmentation& rooms, EditedRooms& result) {
  if (edits.edits.empty()) return;
  const auto now_from_then = building::alignEdits(edits, rooms.storey, signs);
  if (!now_from_then) {
    result.edits.emplace_back("all " + std::to_string(edits.edits.size()) + " edits",
                              "their rooms are not those of this map: they are of another place");
    return;
  }
  for (const auto& edit : building::moved(edits, *now_from_then).edits) {
    result.edits.emplace_back(toString(edit), building::applyEdit(edit, grid, rooms));
    if (result.edits.back().second.empty()) result.layer.rooms.edits.edits.push_back(edit);
  }
}

}  // namespace

EditedRooms roomsOfMap(const mapper::State& state, const grid::GridMap& grid, const building::RoomEdits& edits) {
  EditedRooms result;
  RoomsLayer& layer = result.layer;
  building::Segmentation now = building::segmentRooms(grid);
  if (const auto* earlier = state.map.layers.find<RoomsLayer>()) {
    const auto& storey = earlier->rooms.building.storeys.front();
    auto continued = building::continueRooms(asItIsNow(storey, state.map.key_frames), grid, std::move(now));
    now = std::move(continued.now);
    layer.rooms.gone = std::move(continued.gone);
  }
  const auto landmarks = derived::shapesOf(state);
  const auto signs = signsOf(landmarks);
  const auto* earlier = state.map.layers.find<RoomsLayer>();
  for (const auto* from : {earlier ? &earlier->rooms.edits : nullptr, &edits})
    if (from) takeOver(*from, grid, building::uniqueSigns(signs), now, result);
  building::Storey storey = std::move(now.storey);
  building::nameBySigns(storey, signs);
  const auto contents = contentsOf(landmarks, storey);
  building::nameByContents(storey, contents.by_room, contents.sees_things);
  for (auto& room : storey.rooms) room.anchor = anchorOf(room, state.map.key_frames);
  layer.rooms.edits = building::anchoredTo(std::move(layer.rooms.edits), storey, building::uniqueSigns(signs));
  if (layer.rooms.edits.edits.empty()) layer.rooms.edits.outlines.clear();
  layer.rooms.building.storeys.push_back(std::move(storey));
  return result;
}

}  // namespace omnimapper::plugins
