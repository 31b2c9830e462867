#include "Target.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Distance.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/Route.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "Answers.h"
#include "GoalOfRoom.h"
#include "PlaceText.h"

namespace omnimapper::query {

namespace {

using Eigen::Vector2d;

// "1.5,-2"
std::optional<Vector2d> pointOf(const std::string& text) {
  Vector2d point;
  const char *at = text.data(), *const end = at + text.size();
  for (int i = 0; i < 2; ++i) {
    const auto read = std::from_chars(at, end, point[i]);
    const bool goes_on = read.ptr != end && *read.ptr == ',';
    if (read.ec != std::errc() || !std::isfinite(point[i]) || goes_on != (i == 0)) return std::nullopt;
    at = read.ptr + 1;
    if (i == 1 && read.ptr != end) return std::nullopt;
  }
  for (int i = 0; i < 2; ++i) expectInReach(point[i]);
  return point;
}

std::optional<Target> doorCalled(const MapToAsk& map, const std::string& text) {
  if (!map.rooms) return std::nullopt;
  for (const auto& door : map.rooms->doors)
    if (text == "door " + std::to_string(door.id))
      return Target{text, geometry::middle(door.opening), nullptr, nullptr};
  return std::nullopt;
}

Target targetOf(const FoundRoom& found) {
  return {titleOf(found), found.room ? found.room->centre : found.unseen->door, found.room, nullptr,
          found.match.grade == MatchGrade::near};
}

}  // namespace

std::optional<Target> targetCalled(const MapToAsk& map, const std::string& text) {
  if (text == "here" || text == "me") {
    if (!map.places.last_pose)
      throw base::Error(base::ExitCode::command_line, map.file + ": the map has no last pose: give a point as X,Y");
    return Target{"here", {map.places.last_pose->x, map.places.last_pose->y}};
  }
  if (const auto point = pointOf(text))
    return Target{base::fixed(point->x(), 2) + " " + base::fixed(point->y(), 2), *point};
  if (auto door = doorCalled(map, text)) return door;
  const Found found = find(map.places.places, text);
  const auto rooms = findRooms(map, text);
  const auto here =
      std::find_if(found.places.begin(), found.places.end(), [](const auto& each) { return !each.place->moved; });
  const bool is_room = !rooms.empty() && (here == found.places.end() || rooms.front().match.grade <= here->match.grade);
  if (is_room) return targetOf(rooms.front());
  if (here == found.places.end()) return std::nullopt;
  return Target{titleOf(*here->place) + " (" + toString(here->place->id) + ")", here->place->position.head<2>(),
                nullptr, here->place, found.isOnlyNear()};
}

std::string titleOf(const building::Room& room) {
  const std::string name = building::nameOf(room), number = "room " + std::to_string(room.id);
  return name == number ? number : shownName(name) + " (" + number + ")";
}

std::string titleOf(const FoundRoom& found) {
  return found.room ? titleOf(*found.room) : shownName(found.unseen->name) + " (not seen)";
}

std::optional<Vector2d> standAt(const Target& target, const Vector2d& from, const RoomToMove& room,
                                const GridMap& grid) {
  if (target.room) return freeCentre(*target.room, room, grid);
  if (!target.place) return target.position;
  if (const auto region = roomOfRegion(*target.place))
    if (const auto centre = freeCentre(*region, room, grid)) return centre;
  const auto goal = goalBefore(*target.place, from, room, grid, {});
  if (!goal) return std::nullopt;
  return Vector2d(goal->x, goal->y);
}

std::pair<std::string, std::string> twoTexts(const std::vector<std::string>& words, const std::string& between) {
  const auto joined = [](auto begin, auto end) {
    std::string text;
    for (; begin != end; ++begin) text += (text.empty() ? "" : " ") + *begin;
    return text;
  };
  const auto begin = words.begin() + (!words.empty() && words.front() == "from" ? 1 : 0);
  const auto middle = std::find(begin, words.end(), between);
  if (middle != begin && middle != words.end() && middle + 1 != words.end())
    return {joined(begin, middle), joined(middle + 1, words.end())};
  if (words.end() - begin != 2 || middle != words.end())
    throw base::Error(base::ExitCode::command_line, "give two names, as in: kitchen " + between +
                                                        " room 3. A name may also be a point as X,Y, or 'here'.");
  return {*begin, *(begin + 1)};
}

Json briefJson(const building::Room* room) {
  if (!room) return nullptr;
  return {{"id", "room " + std::to_string(room->id)}, {"name", building::nameOf(*room)}};
}

Json jsonOf(const building::Room& room, const building::Storey& storey) {
  Json doors = Json::array(), neighbours = Json::array(), evidence = Json::array();
  for (const auto& door : storey.doors)
    if (door.rooms[0] == room.id || door.rooms[1] == room.id)
      doors.push_back({{"id", "door " + std::to_string(door.id)},
                       {"position_m", {geometry::middle(door.opening).x(), geometry::middle(door.opening).y()}},
                       {"width_m", door.width},
                       {"to", briefJson(roomOf(storey, door.rooms[0] == room.id ? door.rooms[1] : door.rooms[0]))}});
  for (const int id : room.neighbours) neighbours.push_back(briefJson(roomOf(storey, id)));
  for (const auto& why : room.why)
    evidence.push_back({{"source", toString(why.source)}, {"what", why.what}, {"confidence", why.confidence}});
  Json json = briefJson(&room);
  json["name_confidence"] = room.name_confidence;
  json["kind"] = room.kind.empty() ? Json(nullptr) : Json(room.kind);
  json["kind_confidence"] = room.kind_confidence;
  json["evidence"] = std::move(evidence);
  json["area_m2"] = room.area;
  json["is_open"] = room.isOpen();
  json["confidence"] = room.confidence;
  json["centre_m"] = {room.centre.x(), room.centre.y()};
  json["doors"] = std::move(doors);
  json["neighbours"] = std::move(neighbours);
  return json;
}

Json jsonOf(const building::UnseenRoom& room) {
  Json evidence = Json::array();
  for (const auto& why : room.why)
    evidence.push_back({{"source", toString(why.source)}, {"what", why.what}, {"confidence", why.confidence}});
  return {{"name", room.name},
          {"name_confidence", room.confidence},
          {"evidence", std::move(evidence)},
          {"door_m", {room.door.x(), room.door.y()}},
          {"seen_from", room.seen_from ? Json("room " + std::to_string(*room.seen_from)) : Json(nullptr)}};
}

Json jsonOf(const Target& target) {
  Json json{{"title", target.title}, {"position_m", {target.position.x(), target.position.y()}}};
  json["room"] = briefJson(target.room);
  json["landmark"] = target.place ? Json(toString(target.place->id)) : Json(nullptr);
  json["match_is_near"] = target.is_near;
  return json;
}

}  // namespace omnimapper::query
