#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/building/RoomsFile.h>

#include <charconv>
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

Json poseJson(const geometry::Se2& pose) {
  constexpr double kMicro = 1e6;  // yaw acts over the whole room
  return Json::array({rounded(pose.x), rounded(pose.y), std::round(pose.yaw * kMicro) / kMicro + 0.0});
}

Json evidenceJson(const std::vector<NameEvidence>& why) {
  Json json = Json::array();
  for (const auto& each : why)
    json.push_back({{"source", toString(each.source)}, {"what", each.what}, {"confidence", rounded(each.confidence)}});
  return json;
}

Json roomJson(const Room& room) {
  Json json{{"id", room.id},
            {"name", nameOf(room)},
            {"given_name", room.name},
            {"name_confidence", rounded(room.name_confidence)},
            {"kind", room.kind},
            {"kind_confidence", rounded(room.kind_confidence)},
            {"evidence", evidenceJson(room.why)},
            {"confidence", rounded(room.confidence)},
            {"area_m2", rounded(room.area)},
            {"is_open", room.isOpen()},
            {"openness", rounded(room.openness)},
            {"centre", pointJson(room.centre)},
            {"clearance_m", rounded(room.clearance)},
            {"neighbours", room.neighbours}};
  if (room.split_from) json["split_from"] = *room.split_from;
  if (room.anchor)
    json["anchor"] = {{"key_frame", toString(room.anchor->frame)}, {"pose", poseJson(room.anchor->map_from_frame)}};
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
  const Eigen::Vector2d point(json.at(0).get<double>(), json.at(1).get<double>());
  if (!(point.cwiseAbs().maxCoeff() <= kFarthest)) throw std::out_of_range("a point is too far away");
  return point;
}

std::vector<Eigen::Vector2d> loopOf(const Json& json) {
  std::vector<Eigen::Vector2d> loop;
  for (const auto& point : json) loop.push_back(pointOf(point));
  if (loop.size() < 3) throw std::out_of_range("an outline or a hole has fewer than 3 corners");
  return loop;
}

std::vector<NameEvidence> evidenceOf(const Json& json) {
  using Source = NameEvidence::Source;
  std::vector<NameEvidence> why;
  for (const auto& each : json) {
    const std::string source = each.at("source");
    if (source != "sign" && source != "contents" && source != "user")
      throw std::out_of_range("evidence of an unknown source");
    why.push_back({source == "sign"       ? Source::sign
                   : source == "contents" ? Source::contents
                                          : Source::user,
                   each.at("what"), each.at("confidence")});
  }
  return why;
}

Anchor anchorOf(const Json& json) {
  const std::string id = json.at("key_frame");
  Anchor anchor;
  const auto colon = id.find(':');
  const char* const end = id.data() + id.size();
  const auto session = std::from_chars(id.data(), end, anchor.frame.session);
  if (colon == std::string::npos || session.ec != std::errc() || session.ptr != id.data() + colon)
    throw std::out_of_range("'" + base::printable(id.substr(0, 40)) + "' is no key frame");
  const auto index = std::from_chars(session.ptr + 1, end, anchor.frame.index);
  if (index.ec != std::errc() || index.ptr != end)
    throw std::out_of_range("'" + base::printable(id.substr(0, 40)) + "' is no key frame");
  const Json& pose = json.at("pose");
  const Eigen::Vector2d at = pointOf(pose);
  anchor.map_from_frame = {at.x(), at.y(), pose.at(2)};
  return anchor;
}

Room roomOf(const Json& json) {
  Room room;
  room.id = json.at("id");
  // Documents of the first OmniMapper with rooms have no names.
  if (json.contains("given_name")) {
    room.name = json.at("given_name");
    room.name_confidence = json.at("name_confidence");
    room.kind = json.at("kind");
    room.kind_confidence = json.at("kind_confidence");
    room.why = evidenceOf(json.at("evidence"));
  }
  if (json.contains("anchor")) room.anchor = anchorOf(json.at("anchor"));
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

Json unseenJson(const UnseenRoom& room) {
  Json json{{"name", room.name}, {"door", pointJson(room.door)}, {"confidence", rounded(room.confidence)}};
  json["seen_from"] = room.seen_from ? Json(*room.seen_from) : Json(nullptr);
  json["evidence"] = evidenceJson(room.why);
  return json;
}

UnseenRoom unseenOf(const Json& json) {
  UnseenRoom room;
  room.name = json.at("name");
  room.door = pointOf(json.at("door"));
  room.confidence = json.at("confidence");
  if (!json.at("seen_from").is_null()) room.seen_from = json.at("seen_from").get<int>();
  room.why = evidenceOf(json.at("evidence"));
  return room;
}

Storey storeyOf(const Json& json) {
  Storey storey;
  storey.id = json.at("id");
  storey.next_room = json.at("next_room");
  storey.next_door = json.at("next_door");
  for (const auto& room : json.at("rooms")) storey.rooms.push_back(roomOf(room));
  for (const auto& door : json.at("doors")) storey.doors.push_back(doorOf(door));
  if (json.contains("unseen"))
    for (const auto& room : json.at("unseen")) storey.unseen.push_back(unseenOf(room));
  constexpr int kLargest = 1'000'000'000;
  if (storey.next_room <= 0 || storey.next_room > kLargest || storey.next_door <= 0 || storey.next_door > kLargest)
    throw std::out_of_range("the next id is impossible");
  for (const Room& room : storey.rooms)
    if (room.id <= 0 || room.id >= storey.next_room || !(room.clearance >= 0))
      throw std::out_of_range("room " + std::to_string(room.id) + " has an impossible number");
  return storey;
}

}  // namespace

std::string encodeRooms(const Building& building, const std::vector<int>& gone) {
  return encodeRooms(RoomsDocument{building, gone, {}});
}

std::string encodeRooms(const RoomsDocument& document) {
  Json json{{"schema", kSchema}, {"version", kVersion}, {"frame", "map"}, {"unit", "m"}};
  Json& storeys = json["building"]["storeys"] = Json::array();
  for (const Storey& storey : document.building.storeys) {
    Json each{{"id", storey.id}, {"next_room", storey.next_room}, {"next_door", storey.next_door}};
    each["rooms"] = Json::array();
    for (const Room& room : storey.rooms) each["rooms"].push_back(roomJson(room));
    each["doors"] = Json::array();
    for (const Door& door : storey.doors) each["doors"].push_back(doorJson(door));
    each["unseen"] = Json::array();
    for (const UnseenRoom& room : storey.unseen) each["unseen"].push_back(unseenJson(room));
    storeys.push_back(std::move(each));
  }
  json["gone_rooms"] = document.gone;
  if (!document.edits.edits.empty() || !document.edits.signs.empty() || !document.edits.elsewhere.empty())
    json["edits"] = Json::parse(encodeEdits(document.edits));
  // Names from a map may not be valid UTF-8: invalid bytes are replaced.
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

RoomsDocument decodeRooms(const std::string& text, const std::string& what) {
  const auto refuse = [&](const std::string& reason) {
    throw base::Error(base::ExitCode::unreadable_input, what + ": " + reason);
  };
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("schema", Json()) != kSchema)
    refuse("is no document of rooms: it lacks \"schema\": \"" + std::string(kSchema) + "\".");
  if (json.value("version", Json()) != kVersion) refuse("has another version than " + std::to_string(kVersion) + ".");
  RoomsDocument document;
  try {
    for (const auto& storey : json.at("building").at("storeys")) document.building.storeys.push_back(storeyOf(storey));
    if (json.contains("gone_rooms")) document.gone = json.at("gone_rooms").get<std::vector<int>>();
    if (json.contains("edits")) document.edits = decodeEdits(json.at("edits").dump(), "edits");
  } catch (const std::exception& error) {
    refuse(std::string("is damaged: ") + error.what() + ".");
  }
  if (document.building.storeys.empty()) refuse("has no storey.");
  return document;
}

Building readRooms(const std::string& file) {
  try {
    return decodeRooms(base::readInput(file, "rooms"), file).building;
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::unreadable_input) throw;
    throw base::Error(error.code(), std::string(error.what()) +
                                        " Give the rooms.json that omnimapper-rooms wrote for an earlier map.");
  }
}

}  // namespace omnimapper::building
