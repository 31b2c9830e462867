#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/building/RoomsFile.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace omnimapper::building {

namespace {

using Json = nlohmann::ordered_json;

constexpr char kSchema[] = "omnimapper-rooms";
constexpr int kVersion = 1;

/// Rounded to millimetres, so that the same rooms give the same text.
double rounded(double value) {
  return std::round(value * 1000) / 1000 + 0.0;
}

Json pointJson(const Eigen::Vector2d& point) {
  return Json::array({rounded(point.x()), rounded(point.y())});
}

Json loopJson(const std::vector<Eigen::Vector2d>& loop) {
  Json json = Json::array();
  for (const auto& point : loop) json.push_back(pointJson(point));
  return json;
}

Json roomJson(const Room& room) {
  Json json{{"id", room.id},
            {"name", "room " + std::to_string(room.id)},
            {"confidence", rounded(room.confidence)},
            {"area_m2", rounded(room.area)},
            {"is_open", room.isOpen()},
            {"openness", rounded(room.openness)},
            {"centre", pointJson(room.centre)},
            {"clearance_m", rounded(room.clearance)},
            {"neighbours", room.neighbours}};
  if (room.split_from) json["split_from"] = *room.split_from;
  json["outline"] = loopJson(room.outline);
  json["holes"] = Json::array();
  for (const auto& hole : room.holes) json["holes"].push_back(loopJson(hole));
  return json;
}

Json doorJson(const Door& door) {
  return {{"id", door.id},
          {"kind", "passage"},
          {"confidence", rounded(door.confidence)},
          {"rooms", door.rooms},
          {"position", pointJson(geometry::middle(door.opening))},
          {"from", pointJson(door.opening.from)},
          {"to", pointJson(door.opening.to)},
          {"width_m", rounded(door.width)},
          {"evidence",
           {{"narrowing", rounded(door.evidence.narrowing)},
            {"wall_coverage", rounded(door.evidence.wall_coverage)},
            {"aligned_wall", rounded(door.evidence.aligned_wall)},
            {"wall_crossings", rounded(door.evidence.wall_crossings)}}}};
}

Eigen::Vector2d pointOf(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

std::vector<Eigen::Vector2d> loopOf(const Json& json) {
  std::vector<Eigen::Vector2d> loop;
  for (const auto& point : json) loop.push_back(pointOf(point));
  return loop;
}

Room roomOf(const Json& json) {
  Room room;
  room.id = json.at("id");
  room.confidence = json.at("confidence");
  room.area = json.at("area_m2");
  room.openness = json.at("openness");
  room.centre = pointOf(json.at("centre"));
  room.clearance = json.at("clearance_m");
  room.neighbours = json.at("neighbours").get<std::vector<int>>();
  if (json.contains("split_from")) room.split_from = json.at("split_from").get<int>();
  room.outline = loopOf(json.at("outline"));
  for (const auto& hole : json.at("holes")) room.holes.push_back(loopOf(hole));
  return room;
}

Door doorOf(const Json& json) {
  Door door;
  door.id = json.at("id");
  door.confidence = json.at("confidence");
  door.rooms = json.at("rooms").get<std::array<int, 2>>();
  door.opening = {pointOf(json.at("from")), pointOf(json.at("to"))};
  door.width = json.at("width_m");
  const Json& evidence = json.at("evidence");
  door.evidence = {evidence.at("narrowing"), evidence.at("wall_coverage"), evidence.at("aligned_wall"),
                   evidence.at("wall_crossings")};
  return door;
}

Storey storeyOf(const Json& json) {
  Storey storey;
  storey.id = json.at("id");
  storey.next_room = json.at("next_room");
  storey.next_door = json.at("next_door");
  for (const auto& room : json.at("rooms")) storey.rooms.push_back(roomOf(room));
  for (const auto& door : json.at("doors")) storey.doors.push_back(doorOf(door));
  constexpr int kLargest = 1'000'000'000;
  if (storey.next_room > kLargest || storey.next_door <= 0 || storey.next_door > kLargest)
    throw std::out_of_range("the next id is impossible");
  for (const Room& room : storey.rooms)
    if (room.id <= 0 || room.id >= storey.next_room || !(room.clearance >= 0))
      throw std::out_of_range("room " + std::to_string(room.id) + " has an impossible number");
  return storey;
}

}  // namespace

std::string encodeRooms(const Building& building, const std::vector<int>& gone) {
  Json json{{"schema", kSchema}, {"version", kVersion}, {"frame", "map"}, {"unit", "m"}};
  Json& storeys = json["building"]["storeys"] = Json::array();
  for (const Storey& storey : building.storeys) {
    Json each{{"id", storey.id}, {"next_room", storey.next_room}, {"next_door", storey.next_door}};
    each["rooms"] = Json::array();
    for (const Room& room : storey.rooms) each["rooms"].push_back(roomJson(room));
    each["doors"] = Json::array();
    for (const Door& door : storey.doors) each["doors"].push_back(doorJson(door));
    storeys.push_back(std::move(each));
  }
  json["gone_rooms"] = gone;
  return json.dump(1) + "\n";
}

Building readRooms(const std::string& file) {
  const auto refuse = [&](const std::string& reason) {
    throw base::Error(base::ExitCode::unreadable_input,
                      file + ": " + reason + " Give the rooms.json that omnimapper-rooms wrote for an earlier map.");
  };
  const Json json = Json::parse(base::readInput(file, "rooms"), nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("schema", Json()) != kSchema)
    refuse("is no document of rooms: it lacks \"schema\": \"" + std::string(kSchema) + "\".");
  if (json.value("version", Json()) != kVersion) refuse("has another version than " + std::to_string(kVersion) + ".");
  Building building;
  try {
    for (const auto& storey : json.at("building").at("storeys")) building.storeys.push_back(storeyOf(storey));
  } catch (const std::exception& error) {
    refuse(std::string("is damaged: ") + error.what() + ".");
  }
  if (building.storeys.empty()) refuse("has no storey.");
  return building;
}

}  // namespace omnimapper::building
