#include "SceneGraph.h"

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/ThingsOfMap.h>
#include <omnimapper/geometry/Polygon3.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace omnimapper::plugins {

namespace {

using Json = nlohmann::ordered_json;
using building::Room;
using building::Storey;
using Eigen::Vector2d;
using Eigen::Vector3d;

double rounded(double value) {
  return std::round(value * 1000) / 1000 + 0.0;
}

template <class Point>
Json pointJson(const Point& point) {
  Json json = Json::array();
  for (int i = 0; i < point.size(); ++i) json.push_back(rounded(point[i]));
  return json;
}

std::string idOf(const Room& room) {
  return "room " + std::to_string(room.id);
}

/// The nodes and relations of the document.
struct Graph {
  Json nodes = Json::array(), relations = Json::array();

  void relate(const std::string& kind, const std::string& from, const std::string& to) {
    relations.push_back({{"kind", kind}, {"from", from}, {"to", to}});
  }
};

void addRooms(const Storey& storey, const std::string& storey_id, Graph& graph) {
  for (const Room& room : storey.rooms) {
    Json outline = Json::array();
    for (const auto& corner : room.outline) outline.push_back(pointJson(corner));
    graph.nodes.push_back({{"id", idOf(room)},
                           {"kind", "room"},
                           {"name", building::nameOf(room)},
                           {"name_confidence", rounded(room.name_confidence)},
                           {"room_kind", room.kind},
                           {"room_kind_confidence", rounded(room.kind_confidence)},
                           {"confidence", rounded(room.confidence)},
                           {"is_seen", true},
                           {"is_open", room.isOpen()},
                           {"position_m", pointJson(room.centre)},
                           {"area_m2", rounded(room.area)},
                           {"outline_m", std::move(outline)}});
    graph.relate("contains", storey_id, idOf(room));
  }
  for (std::size_t i = 0; i < storey.unseen.size(); ++i) {
    const auto& room = storey.unseen[i];
    const std::string id = "unseen " + std::to_string(i + 1);
    graph.nodes.push_back({{"id", id},
                           {"kind", "room"},
                           {"name", room.name},
                           {"name_confidence", rounded(room.confidence)},
                           {"is_seen", false},
                           {"position_m", pointJson(room.door)}});
    graph.relate("contains", storey_id, id);
    if (room.seen_from) graph.relate("next to", "room " + std::to_string(*room.seen_from), id);
  }
}

void addDoors(const Storey& storey, const std::string& storey_id, Graph& graph) {
  for (const auto& door : storey.doors) {
    const std::string id = "door " + std::to_string(door.id);
    graph.nodes.push_back({{"id", id},
                           {"kind", "door"},
                           {"confidence", rounded(door.confidence)},
                           {"position_m", pointJson(geometry::middle(door.opening))},
                           {"from_m", pointJson(door.opening.from)},
                           {"to_m", pointJson(door.opening.to)},
                           {"width_m", rounded(door.width)}});
    graph.relate("contains", storey_id, id);
    for (const int room : door.rooms) graph.relate("through", id, "room " + std::to_string(room));
  }
  for (const Room& room : storey.rooms)
    for (const int other : room.neighbours)
      if (room.id < other) graph.relate("next to", idOf(room), "room " + std::to_string(other));
}

std::string kindOf(const map::LandmarkShape& shape) {
  if (shape.label == "sign") return "sign";
  return shape.surfaces.empty() && shape.lines.empty() ? "object" : "surface";
}

void addLandmarks(const std::vector<derived::ShapedLandmark>& landmarks, const Storey& storey,
                  const std::string& storey_id, Graph& graph) {
  for (const auto& [landmark, shape, moved] : landmarks) {
    const Vector3d middle = derived::referencePoint(shape);
    const Eigen::AlignedBox3d box = derived::boxOf(shape);
    const std::string id = toString(landmark->id);
    Json node{{"id", id},
              {"kind", kindOf(shape)},
              {"label", shape.label},
              {"caption", shape.caption},
              {"position_m", pointJson(middle)},
              {"low_m", pointJson(Vector3d(box.min()))},
              {"high_m", pointJson(Vector3d(box.max()))},
              {"measurements", landmark->evidence}};
    if (shape.normal) node["normal"] = pointJson(*shape.normal);
    graph.nodes.push_back(std::move(node));
    std::optional<Vector2d> free_side;
    if (shape.normal) free_side = shape.normal->head<2>();
    const Room* room = building::roomOfThing(storey, middle.head<2>(), free_side);
    graph.relate("contains", room ? idOf(*room) : storey_id, id);
  }
}

// A level surface below the thing, on which it stands: its index, or none.
std::optional<std::size_t> supportOf(std::size_t thing, const std::vector<derived::ShapedLandmark>& landmarks) {
  constexpr double kNear = 0.08;   // [m] between the surface and the lowest point
  constexpr double kLevel = 0.95;  // of the vertical part of the normal
  const Eigen::AlignedBox3d box = derived::boxOf(landmarks[thing].shape);
  const Vector2d middle = derived::referencePoint(landmarks[thing].shape).head<2>();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto& shape = landmarks[i].shape;
    if (i == thing || shape.label == "floor" || !shape.normal || std::abs(shape.normal->z()) < kLevel) continue;
    for (const auto& surface : shape.surfaces) {
      Room outline;
      double height = 0;
      for (const auto& corner : surface.vertices) {
        outline.outline.push_back(corner.head<2>());
        height += corner.z() / static_cast<double>(surface.vertices.size());
      }
      if (std::abs(box.min().z() - height) < kNear && building::contains(outline, middle)) return i;
    }
  }
  return std::nullopt;
}

void addSupports(const std::vector<derived::ShapedLandmark>& landmarks, Graph& graph) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (kindOf(landmarks[i].shape) != "object") continue;
    if (const auto support = supportOf(i, landmarks))
      graph.relate("on", toString(landmarks[i].landmark->id), toString(landmarks[*support].landmark->id));
  }
}

// The things of several faces, each with its faces.
void addThings(const std::vector<derived::ShapedLandmark>& landmarks, const map::Map& map, const Storey& storey,
               const std::string& storey_id, Graph& graph) {
  for (const auto& thing : derived::thingsOf(landmarks, map)) {
    if (thing.faces.size() < 2) continue;
    const std::string id = "thing " + toString(landmarks[thing.faces.front()].landmark->id);
    const Vector3d middle(thing.middle.x(), thing.middle.y(), (thing.bottom + thing.top) / 2);
    graph.nodes.push_back({{"id", id},
                           {"kind", "thing"},
                           {"label", toString(thing.is)},
                           {"position_m", pointJson(middle)},
                           {"size_m", pointJson(Vector3d(thing.length, thing.width, thing.top - thing.bottom))},
                           {"direction_rad", rounded(thing.direction)}});
    const Room* room = building::roomOfThing(storey, thing.middle, std::nullopt);
    graph.relate("contains", room ? idOf(*room) : storey_id, id);
    for (const std::size_t face : thing.faces) graph.relate("contains", id, toString(landmarks[face].landmark->id));
  }
}

// Places are key frames that are apart from each other; those between which the base drove are next to each other.
void addPlaces(const map::KeyFrames& key_frames, const Storey& storey, const std::string& storey_id, Graph& graph) {
  constexpr double kApart = 1.5, kStep = 3;  // [m]
  std::vector<std::pair<std::string, Vector2d>> places;
  std::optional<std::size_t> last;
  std::vector<std::pair<std::size_t, std::size_t>> driven;
  for (const auto& frame : key_frames) {
    const Vector2d at(frame.map_from_base.x(), frame.map_from_base.y());
    std::optional<std::size_t> nearest;
    double least = kApart;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const double distance = (places[i].second - at).norm(); distance < least) {
        least = distance;
        nearest = i;
      }
    if (!nearest) {
      nearest = places.size();
      places.emplace_back("place " + toString(frame.id), at);
      graph.nodes.push_back({{"id", places.back().first}, {"kind", "place"}, {"position_m", pointJson(at)}});
      const Room* room = building::roomAt(storey, at);
      graph.relate("contains", room ? idOf(*room) : storey_id, places.back().first);
    }
    if (last && *last != *nearest && (places[*last].second - places[*nearest].second).norm() < kStep)
      driven.emplace_back(std::min(*last, *nearest), std::max(*last, *nearest));
    last = nearest;
  }
  std::sort(driven.begin(), driven.end());
  driven.erase(std::unique(driven.begin(), driven.end()), driven.end());
  for (const auto& [one, other] : driven) graph.relate("next to", places[one].first, places[other].first);
}

}  // namespace

std::string encodeSceneGraph(const mapper::State& state, const Storey& storey, const std::string& title) {
  Graph graph;
  const std::string storey_id = "storey " + std::to_string(storey.id);
  graph.nodes.push_back({{"id", "building"}, {"kind", "building"}, {"name", title}});
  graph.nodes.push_back({{"id", storey_id}, {"kind", "storey"}});
  graph.relate("contains", "building", storey_id);
  addRooms(storey, storey_id, graph);
  addDoors(storey, storey_id, graph);
  std::vector<derived::ShapedLandmark> landmarks;
  for (auto& shaped : derived::shapesOf(state))
    if (!shaped.moved && shaped.isSomewhere()) landmarks.push_back(std::move(shaped));
  addLandmarks(landmarks, storey, storey_id, graph);
  addThings(landmarks, state.map, storey, storey_id, graph);
  addSupports(landmarks, graph);
  addPlaces(state.map.key_frames, storey, storey_id, graph);
  Json document{{"schema", "omnimapper-scene-graph"}, {"version", 1}, {"frame", "map"}, {"unit", "m"}};
  document["nodes"] = std::move(graph.nodes);
  document["relations"] = std::move(graph.relations);
  // Names from a log may not be valid UTF-8: invalid bytes are replaced.
  return document.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace omnimapper::plugins
