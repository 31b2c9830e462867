#include "RoomAnswers.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/RoomsAsked.h>

#include <algorithm>

#include "Answers.h"
#include "FoundText.h"
#include "PlaceJson.h"
#include "PlaceText.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

using base::fixed;
using building::Room;
using building::Storey;
using Eigen::Vector2d;
using Lines = std::vector<std::vector<std::string>>;

std::string percent(double share) {
  return fixed(100 * share, 0) + " %";
}

std::string neighboursText(const Room& room, const Storey& storey) {
  std::string text;
  for (const int id : room.neighbours)
    if (const Room* other = roomOf(storey, id))
      text += (text.empty() ? "" : ", ") + shownName(building::nameOf(*other));
  return text;
}

std::string kindText(const Room& room) {
  const bool is_sure = !room.kind.empty() && room.kind_confidence >= building::kSureKind;
  return is_sure ? shownName(room.kind) + " (" + percent(room.kind_confidence) + ")" : "";
}

std::string whyText(const std::vector<building::NameEvidence>& why) {
  std::string text;
  for (const auto& each : why)
    text += "  " + toString(each.source) + ": " + base::printable(each.what) + " (" + percent(each.confidence) + ")\n";
  return text;
}

Lines roomLines(const Storey& storey) {
  Lines lines{{"id", "name", "kind", "area [m2]", "centre x y [m]", "seen", "beside"}};
  for (const Room& room : storey.rooms)
    lines.push_back({"room " + std::to_string(room.id), shownName(room.name), kindText(room), fixed(room.area, 1),
                     pointText(room.centre), room.isOpen() ? "in part" : "", neighboursText(room, storey)});
  return lines;
}

std::string nothingText(const MapToAsk& map, const std::string& text) {
  std::string names;
  for (const Room& room : roomsOf(map).rooms) names += (names.empty() ? "" : ", ") + titleOf(room);
  for (const auto& room : roomsOf(map).unseen) names += (names.empty() ? "" : ", ") + shownName(room.name);
  return "no room is called '" + shownName(text) + "'; there are: " + names + "\n";
}

// "room is the mug in": the words of the question around the name are left out.
std::string thingAsked(std::vector<std::string> words) {
  for (const char* leading : {"room", "rooms", "is", "are", "the", "a"})
    if (words.size() > 1 && words.front() == leading) words.erase(words.begin());
  if (words.size() > 1 && words.back() == "in") words.pop_back();
  Request request;
  request.words = std::move(words);
  return textOf(request);
}

std::string roomWordsOf(const Request& request) {
  Request rest = request;
  if (rest.words.size() > 1 && rest.words.front() == "the") rest.words.erase(rest.words.begin());
  return textOf(rest);
}

}  // namespace

Answer answerRooms(const MapToAsk& map, const Request&) {
  const Storey& storey = roomsOf(map);
  Json document = answerTo("rooms", map);
  document["rooms"] = document["unseen"] = Json::array();
  for (const Room& room : storey.rooms) document["rooms"].push_back(jsonOf(room, storey));
  for (const auto& room : storey.unseen) document["unseen"].push_back(jsonOf(room));
  std::string text = base::counted(storey.rooms.size(), "room") + ", " + base::counted(storey.doors.size(), "door") +
                     "\n" + (storey.rooms.empty() ? "" : alignedTable(roomLines(storey)));
  if (!storey.unseen.empty()) {
    text += base::counted(storey.unseen.size(), "room") + " behind known doors, not seen\n";
    Lines lines{{"name", "door x y [m]", "seen from"}};
    for (const auto& room : storey.unseen)
      lines.push_back({shownName(room.name), pointText(room.door),
                       room.seen_from ? "room " + std::to_string(*room.seen_from) : ""});
    text += alignedTable(lines);
  }
  return {text, textOf(document), base::ExitCode::ok};
}

Answer answerWhere(const MapToAsk& map, const Request& request) {
  Request rest = request;
  for (const char* leading : {"am", "i", "I", "is"})
    if (!rest.words.empty() && rest.words.front() == leading) rest.words.erase(rest.words.begin());
  if (!request.words.empty() && request.words.front() == "is") return answerFind(map, rest);
  const Storey& storey = roomsOf(map);
  Vector2d point;
  if (rest.words.size() == 2) {
    point = pointOf(rest);
  } else if (rest.words.empty() && map.places.last_pose) {
    point = {map.places.last_pose->x, map.places.last_pose->y};
  } else {
    throw base::Error(base::ExitCode::command_line,
                      rest.words.empty() ? map.file + ": the map has no last pose; give a point: where am i X Y"
                                         : "give a point in metres, as in: where am i 3.5 -2; or: where is kitchen");
  }
  const auto near = nearestRoom(storey, point);
  const Room* room = roomOfThing(storey, point, std::nullopt);
  Json document = answerTo("where", map);
  document["point_m"] = {point.x(), point.y()};
  document["room"] = room ? jsonOf(*room, storey) : Json(nullptr);
  document["nearest"] = near ? briefJson(near->room) : Json(nullptr);
  document["distance_m"] = near ? Json(near->distance) : Json(nullptr);
  if (room)
    return {pointText(point) + " is in " + titleOf(*room) +
                (near->distance > 0 ? ", " + fixed(near->distance, 1) + " m outside of its free space" : "") + "\n" +
                whyText(room->why),
            textOf(document), base::ExitCode::ok};
  return {pointText(point) + " is in no room" +
              (near ? "; " + titleOf(*near->room) + " is " + fixed(near->distance, 1) + " m away" : "") + "\n",
          textOf(document), base::ExitCode::nothing_found};
}

Answer answerIn(const MapToAsk& map, const Request& request) {
  const std::string text = roomWordsOf(request);
  const Storey& storey = roomsOf(map);
  find({}, text);  // refuses texts that are none
  const auto found = findRooms(map, text);
  Json document = answerTo("in", map);
  document["text"] = text;
  document["rooms"] = Json::array();
  if (found.empty()) return {nothingText(map, text), textOf(document), base::ExitCode::nothing_found};
  std::string said;
  for (const auto& each : found) {
    if (each.match.grade == MatchGrade::near)
      said += "no room is called '" + shownName(text) + "'; nearest: '" + shownName(each.match.name) + "'\n";
    if (!each.room) {
      said += titleOf(each) + ": its door is at " + pointText(each.unseen->door) + "; the room itself was not seen\n" +
              whyText(each.unseen->why);
      Json json = jsonOf(*each.unseen);
      json["places"] = nullptr;
      document["rooms"].push_back(std::move(json));
      continue;
    }
    Json json = jsonOf(*each.room, storey);
    json["match"] = toString(each.match.grade);
    json["places"] = Json::array();
    Lines lines{placeHeads()};
    for (const auto& place : map.places.places) {
      if (place.moved || roomOf(storey, place) != each.room) continue;
      lines.push_back(cellsOf(place));
      json["places"].push_back(jsonOf(place, request.brief));
    }
    said += titleOf(*each.room) + ", " + fixed(each.room->area, 1) + " m2" +
            (each.room->isOpen() ? ", seen in part" : "") + ": " + base::counted(lines.size() - 1, "landmark") + "\n" +
            whyText(each.room->why) + (lines.size() > 1 ? tableOf(lines) : "");
    document["rooms"].push_back(std::move(json));
  }
  return {said, textOf(document), base::ExitCode::ok};
}

Answer answerWhich(const MapToAsk& map, const Request& request) {
  const std::string text = thingAsked(request.words);
  const Storey& storey = roomsOf(map);
  const Found found = find(map.places.places, text);
  Json document = answerTo("which", map);
  document["text"] = text;
  document["matches"] = matchesJson(found, map, request.brief);
  document["closest"] = found.closest;
  if (found.places.empty()) return {nothingCalled(text, found), textOf(document), base::ExitCode::nothing_found};
  Lines lines{{"room", "name", "id"}};
  bool is_any = false;
  for (const auto& each : found.places) {
    const Room* room = roomOf(storey, *each.place);
    is_any = is_any || room;
    lines.push_back({room ? titleOf(*room) : "in no room", titleOf(*each.place), toString(each.place->id)});
  }
  return {foundLine(text, found) + tableOf(lines), textOf(document),
          is_any ? base::ExitCode::ok : base::ExitCode::nothing_found};
}

}  // namespace omnimapper::query
