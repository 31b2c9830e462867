#include <omnimapper/draw/LabelColours.h>
#include <omnimapper/query/MapDocument.h>

#include <cstdio>
#include <string>

#include "CorrectionAnswers.h"
#include "PlaceJson.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

Json pointJson(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

Json walkJson(const std::vector<Eigen::Vector2d>& walk) {
  Json list = Json::array();
  for (const auto& point : walk) list.push_back(pointJson(point));
  return list;
}

Json roomJson(const building::Room& room, const building::Storey& storey) {
  Json json = jsonOf(room, storey);
  json["outline_m"] = walkJson(room.outline);
  json["holes_m"] = Json::array();
  for (const auto& hole : room.holes) json["holes_m"].push_back(walkJson(hole));
  return json;
}

Json doorJson(const building::Door& door, const building::Storey& storey) {
  return {{"id", "door " + std::to_string(door.id)},
          {"from_m", pointJson(door.opening.from)},
          {"to_m", pointJson(door.opening.to)},
          {"width_m", door.width},
          {"confidence", door.confidence},
          {"rooms", {briefJson(roomOf(storey, door.rooms[0])), briefJson(roomOf(storey, door.rooms[1]))}}};
}

// How a page draws what has that label.
Json styleOf(const std::string& label) {
  const draw::Rgb colour = draw::colourOfLabel(label);
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return {{"colour", text}, {"covers_the_plan", draw::coversThePlan(label)}};
}

void addRooms(const building::Storey& storey, Json& document) {
  for (const auto& room : storey.rooms) document["rooms"].push_back(roomJson(room, storey));
  for (const auto& door : storey.doors) document["doors"].push_back(doorJson(door, storey));
  for (const auto& room : storey.unseen) document["unseen"].push_back(jsonOf(room));
}

}  // namespace

std::string mapDocument(const MapToAsk& map) {
  Json document = answerTo("map", map);
  document.erase("map");  // the path of a file on this machine is nothing for a page
  document["version"] = 1;
  const auto& pose = map.places.last_pose;
  document["last_pose"] = pose ? Json{{"x_m", pose->x}, {"y_m", pose->y}, {"yaw_rad", pose->yaw}} : Json(nullptr);
  for (const char* list : {"places", "rooms", "doors", "unseen", "loops", "deleted"}) document[list] = Json::array();
  document["labels"] = Json::object();
  for (const auto& place : map.places.places) {
    document["labels"][place.label] = styleOf(place.label);
    Json json = jsonOf(place);
    const auto* room = map.rooms ? roomOf(*map.rooms, place) : nullptr;
    json["room"] = briefJson(room);
    document["places"].push_back(std::move(json));
  }
  if (map.rooms) addRooms(*map.rooms, document);
  for (const auto& loop : map.loops) document["loops"].push_back(loopJson(loop, map.corrections));
  for (const auto& thing : map.corrections.deleted) document["deleted"].push_back(deletedJson(thing));
  return textOf(document);
}

}  // namespace omnimapper::query
