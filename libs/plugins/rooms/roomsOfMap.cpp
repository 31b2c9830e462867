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

bool isSame(const building::RoomEdit& a, const building::RoomEdit& b) {
  const auto areClose = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    constexpr double kClose = 0.01;  // [m]
    return (p - q).norm() <= kClose;
  };
  return a.kind == b.kind && a.name == b.name &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), areClose);
}

// Edits of the place, each also in the frame of the map of now.
struct PlacedEdits {
  building::RoomEdits then, now;
  bool are_placed = false;
};

PlacedEdits placed(const building::RoomEdits& edits, const building::Storey& storey,
                   const std::map<std::string, Eigen::Vector2d>& signs) {
  const auto now_from_then = building::alignEdits(edits, storey, signs);
  if (!now_from_then) return {edits, {}, false};
  return {edits, building::moved(edits, *now_from_then), true};
}

// Without those that are among the known ones, in either frame; each known one stands for one.
void forgetKnown(PlacedEdits known, PlacedEdits& edits) {
  const auto has = [](const PlacedEdits& all, std::size_t i, const PlacedEdits& others, std::size_t j) {
    return isSame(all.then.edits[i], others.then.edits[j]) ||
           (all.are_placed && others.are_placed && isSame(all.now.edits[i], others.now.edits[j]));
  };
  const auto forget = [](PlacedEdits& all, std::size_t i) {
    all.then.edits.erase(all.then.edits.begin() + static_cast<std::ptrdiff_t>(i));
    if (all.are_placed) all.now.edits.erase(all.now.edits.begin() + static_cast<std::ptrdiff_t>(i));
  };
  for (std::size_t i = 0; i < edits.then.edits.size();) {
    std::size_t j = 0;
    while (j < known.then.edits.size() && !has(edits, i, known, j)) ++j;
    if (j == known.then.edits.size()) {
      ++i;
      continue;
    }
    forget(edits, i);
    forget(known, j);
  }
}

// The edits of the map, or of a file, one set for each place.
std::vector<building::RoomEdits> setsOf(const building::RoomEdits& edits) {
  std::vector<building::RoomEdits> sets{edits};
  sets.front().elsewhere.clear();
  sets.insert(sets.end(), edits.elsewhere.begin(), edits.elsewhere.end());
  sets.erase(std::remove_if(sets.begin(), sets.end(), [](const auto& set) { return set.edits.empty(); }), sets.end());
  return sets;
}

// Applies edits that the map has, which it keeps, or those of a file.
void takeOver(const PlacedEdits& edits, bool are_of_map, const grid::GridMap& grid, building::Segmentation& rooms,
              EditedRooms& result) {
  if (edits.then.edits.empty()) return;
  const std::string kept = are_of_map ? "; kept for a later session" : "";
  auto& of_layer = result.layer.rooms.edits;
  if (!edits.are_placed) {
    result.edits.emplace_back("all " + std::to_string(edits.then.edits.size()) + " edits",
                              "their rooms are not those of this map: they are of another place" + kept);
    if (are_of_map) of_layer.elsewhere.push_back(edits.then);
  }
  for (const auto& edit : edits.now.edits) {
    const std::string why_not = building::applyEdit(edit, grid, rooms);
    result.edits.emplace_back(toString(edit), why_not.empty() ? "" : why_not + kept);
    if (why_not.empty() || are_of_map) of_layer.edits.push_back(edit);
  }
}

// Applies the edits that the map has. Rooms that they made have the numbers that they had before.
std::vector<PlacedEdits> takeOverOwn(const RoomsLayer& earlier, const building::Storey& storey,
                                     const grid::GridMap& grid, const std::map<std::string, Eigen::Vector2d>& signs,
                                     building::Segmentation& rooms, EditedRooms& result) {
  const auto continueThem = [&] {
    auto continued = building::continueRooms(storey, grid, std::move(rooms));
    rooms = std::move(continued.now);
    result.layer.rooms.gone = std::move(continued.gone);
  };
  continueThem();
  std::vector<PlacedEdits> own;
  for (const auto& set : setsOf(earlier.rooms.edits)) own.push_back(placed(set, rooms.storey, signs));
  for (const auto& set : own) takeOver(set, true, grid, rooms, result);
  if (!own.empty()) continueThem();
  return own;
}

// Applies those edits of a file that the map does not have.
void takeOverFile(const building::RoomEdits& of_file, const std::vector<PlacedEdits>& own, const grid::GridMap& grid,
                  const std::map<std::string, Eigen::Vector2d>& signs, building::Segmentation& rooms,
                  EditedRooms& result) {
  for (const auto& set : setsOf(of_file)) {
    PlacedEdits given = placed(set, rooms.storey, signs);
    for (const auto& known : own) forgetKnown(known, given);
    takeOver(given, false, grid, rooms, result);
  }
}

}  // namespace

EditedRooms roomsOfMap(const mapper::State& state, const grid::GridMap& grid, const building::RoomEdits& edits) {
  EditedRooms result;
  RoomsLayer& layer = result.layer;
  building::Segmentation now = building::segmentRooms(grid);
  const auto landmarks = derived::shapesOf(state);
  const auto signs = signsOf(landmarks);
  const auto by_text = building::uniqueSigns(signs);
  std::vector<PlacedEdits> own;
  if (const auto* earlier = state.map.layers.find<RoomsLayer>()) {
    const auto then = asItIsNow(earlier->rooms.building.storeys.front(), state.map.key_frames);
    own = takeOverOwn(*earlier, then, grid, by_text, now, result);
  }
  takeOverFile(edits, own, grid, by_text, now, result);
  auto& of_layer = layer.rooms.edits;
  of_layer = building::anchoredTo(std::move(of_layer), now.storey, by_text);
  if (of_layer.edits.empty()) of_layer.outlines.clear();
  building::Storey storey = std::move(now.storey);
  building::nameBySigns(storey, signs);
  const auto contents = contentsOf(landmarks, storey);
  building::nameByContents(storey, contents.by_room, contents.sees_things);
  for (auto& room : storey.rooms) room.anchor = anchorOf(room, state.map.key_frames);
  layer.rooms.building.storeys.push_back(std::move(storey));
  return result;
}

}  // namespace omnimapper::plugins
