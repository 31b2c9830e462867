#include "Answers.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Distance.h>
#include <omnimapper/query/Find.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "FoundText.h"
#include "PlaceJson.h"
#include "PlaceText.h"
#include "SurfaceAnswers.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

constexpr std::size_t kMostLines = 40;  // largest number of places in the text of an answer; its JSON has all

using Lines = std::vector<std::vector<std::string>>;

/// The cells of a line with that of the room at the end.
std::vector<std::string> withRoom(const std::string& room, std::vector<std::string> cells) {
  cells.push_back(room);
  return cells;
}

/// What the room that a landmark is in is called; empty if it is in none.
std::string roomName(const MapToAsk& map, const map::Place& place) {
  const auto* room = map.rooms ? roomOf(*map.rooms, place) : nullptr;
  return room ? shownName(building::nameOf(*room)) : "";
}

Json roomMatchesJson(const std::vector<FoundRoom>& rooms, const MapToAsk& map) {
  Json matches = Json::array();
  for (const auto& each : rooms) {
    Json match{{"match", toString(each.match.grade)}, {"is_seen", each.room != nullptr}};
    match.update(each.room ? jsonOf(*each.room, *map.rooms) : jsonOf(*each.unseen));
    matches.push_back(std::move(match));
  }
  return matches;
}

std::string roomMatchesText(const std::string& text, const std::vector<FoundRoom>& rooms) {
  std::string said;
  for (const auto& each : rooms) {
    if (each.match.grade == MatchGrade::near)
      said += "nothing is called '" + shownName(text) + "'; nearest: '" + shownName(each.match.name) + "'\n";
    const Eigen::Vector2d at = each.room ? each.room->centre : each.unseen->door;
    said += titleOf(each) + (each.room ? ": its centre is at " : ": its door is at ") + base::fixed(at.x(), 2) + " " +
            base::fixed(at.y(), 2) + (each.room ? ", " + base::fixed(each.room->area, 1) + " m2\n" : "\n");
  }
  return said;
}

std::vector<std::string> withFirst(const std::string& first, std::vector<std::string> cells) {
  cells.insert(cells.begin(), first);
  return cells;
}

double coordinateOf(const std::string& word) {
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data() + (word.rfind('+', 0) == 0 ? 1 : 0), end, number);
  if (word.empty() || read.ec != std::errc() || read.ptr != end || !std::isfinite(number))
    throw base::Error(
        base::ExitCode::command_line,
        "'" + shownName(word) + "' is not a coordinate: give x and y of the map in metres, as in near 3.5 -2");
  expectInReach(number);
  return number;
}

std::vector<const map::Place*> ofKind(const MapToAsk& map, const std::string& kind) {
  std::vector<const map::Place*> places;
  for (const auto& place : map.places.places)
    if (place.kind == kind) places.push_back(&place);
  std::sort(places.begin(), places.end(), [](const auto* a, const auto* b) {
    for (const auto& [left, right] : {std::pair(&a->caption, &b->caption), std::pair(&a->label, &b->label)}) {
      if (left->empty() != right->empty()) return right->empty();
      if (*left != *right) return naturallyBefore(*left, *right);
    }
    return a->id < b->id;
  });
  return places;
}

std::map<std::string, std::size_t> countsOf(const MapToAsk& map) {
  std::map<std::string, std::size_t> counts;
  for (const auto& place : map.places.places) ++counts[place.kind];
  return counts;
}

Answer listKinds(const MapToAsk& map) {
  Json document = answerTo("list", map);
  document["kinds"] = Json::object();
  Lines lines{{"kind", "count"}};
  for (const auto& [kind, count] : countsOf(map)) {
    lines.push_back({shownName(kind), std::to_string(count)});
    document["kinds"][kind] = count;
  }
  return {lines.size() > 1 ? tableOf(lines) : "the map has no landmarks\n", textOf(document), base::ExitCode::ok};
}

}  // namespace

std::string tableOf(Lines lines) {
  const std::size_t count = lines.size() - 1;
  if (count > kMostLines) lines.resize(kMostLines + 1);
  return alignedTable(lines) +
         (count > kMostLines ? "  and " + std::to_string(count - kMostLines) + " more: --json has them all\n" : "");
}

Eigen::Vector2d pointOf(const Request& request) {
  return {coordinateOf(request.words.at(0)), coordinateOf(request.words.at(1))};
}

std::string textOf(const Request& request) {
  std::string text;
  for (const auto& word : request.words) text += (text.empty() ? "" : " ") + word;
  return text;
}

void expectInReach(double coordinate) {
  constexpr double kFarthest = 1e7;  // [m] beyond it a double cannot resolve micrometres, and no map has anything
  if (std::abs(coordinate) > kFarthest)
    throw base::Error(base::ExitCode::command_line, base::brief(coordinate) +
                                                        " m is not a coordinate of a map: none is " +
                                                        "farther than 10000 km from the origin");
}

std::vector<double> numbersOf(const Request& request, const std::string& option, const std::vector<double>& otherwise) {
  const auto given = request.numbers.find(option);
  if (given == request.numbers.end() || given->second.empty()) return otherwise;
  for (const double number : given->second)
    if (!std::isfinite(number))
      throw base::Error(base::ExitCode::command_line, "--" + option + " needs finite numbers, in metres");
  return given->second;
}

Answer answerFind(const MapToAsk& map, const Request& request) {
  const auto on = request.texts.find("on");
  if (on != request.texts.end() && !on->second.empty()) return answerFindOn(map, request, on->second);
  const std::string text = textOf(request);
  const Found found = find(map.places.places, text);
  Json document = answerTo("find", map);
  document["text"] = text;
  document["matches"] = matchesJson(found, map, request.brief);
  document["closest"] = found.closest;
  // A room whose name is only similar counts only if no landmark has the name.
  auto rooms = findRooms(map, text);
  const bool are_near = !rooms.empty() && rooms.front().match.grade == MatchGrade::near;
  if (are_near && !found.places.empty()) rooms.clear();
  document["rooms"] = roomMatchesJson(rooms, map);
  if (found.places.empty() && rooms.empty())
    return {nothingCalled(text, found), textOf(document), base::ExitCode::nothing_found};
  std::string said = roomMatchesText(text, rooms);
  if (!found.places.empty()) {
    Lines lines{withRoom("room", withFirst("match", placeHeads()))};
    for (const auto& each : found.places)
      lines.push_back(
          withRoom(roomName(map, *each.place), withFirst(toString(each.match.grade), cellsOf(*each.place))));
    said += foundLine(text, found) + tableOf(lines);
  }
  return {said, textOf(document), base::ExitCode::ok};
}

Answer answerNear(const MapToAsk& map, const Request& request) {
  constexpr std::size_t kFew = 5;
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d point = pointOf(request);
  const auto within = numbersOf(request, "within", {});
  const auto near = within.empty() ? nearestPlaces(map.places.places, point, kAnywhere, kFew)
                                   : nearestPlaces(map.places.places, point, within[0], map.places.places.size());
  Json document = answerTo("near", map);
  document["point_m"] = {point.x(), point.y()};
  document["within_m"] = within.empty() ? Json(nullptr) : Json(within[0]);
  document["places"] = Json::array();
  Lines lines{withFirst("distance [m]", placeHeads())};
  for (const auto& each : near) {
    lines.push_back(withFirst(base::fixed(each.distance, 2), cellsOf(*each.place)));
    Json place = jsonOf(*each.place, request.brief);
    place["distance_m"] = each.distance;
    document["places"].push_back(std::move(place));
  }
  if (!near.empty()) return {tableOf(lines), textOf(document), base::ExitCode::ok};
  const std::string where = within.empty() ? "the map has no landmarks"
                                           : "nothing is within " + base::brief(within[0]) + " m of " +
                                                 base::fixed(point.x(), 2) + " " + base::fixed(point.y(), 2);
  return {where + "\n", textOf(document), base::ExitCode::nothing_found};
}

Answer answerList(const MapToAsk& map, const Request& request) {
  if (request.words.empty()) return listKinds(map);
  const std::string asked = textOf(request);
  // Kinds are found in the same way as places: each is represented by a place that has only its kind.
  std::vector<map::Place> kinds;
  for (const auto& [kind, count] : countsOf(map)) {
    map::Place place;
    place.label = place.kind = kind;
    kinds.push_back(place);
  }
  const Found found = find(kinds, asked);
  Json document = answerTo("list", map);
  document["text"] = asked;
  document["kind"] = found.places.empty() ? Json(nullptr) : Json(found.places.front().place->kind);
  document["places"] = Json::array();
  document["closest"] = found.closest;
  if (found.places.empty())
    return {"no kind is called '" + shownName(asked) + "'; there are: " + namesText(kinds) + "\n", textOf(document),
            base::ExitCode::nothing_found};
  Lines lines{placeHeads()};
  for (const auto* place : ofKind(map, found.places.front().place->kind)) {
    lines.push_back(cellsOf(*place));
    document["places"].push_back(jsonOf(*place, request.brief));
  }
  const std::string said = found.isOnlyNear() ? "no kind is called '" + shownName(asked) +
                                                    "'; nearest: " + shownName(found.places.front().place->kind) + "\n"
                                              : "";
  return {said + tableOf(lines), textOf(document), base::ExitCode::ok};
}

Answer answerLayers(const MapToAsk& map, const Request&) {
  Json document = answerTo("layers", map);
  document["layers"] = Json::array();
  Lines lines{{"layer", "version", "bytes"}};
  for (const auto& layer : map.layers) {
    lines.push_back({shownName(layer.name), std::to_string(layer.version), std::to_string(layer.size)});
    document["layers"].push_back({{"name", layer.name}, {"version", layer.version}, {"bytes", layer.size}});
  }
  return {tableOf(lines), textOf(document), base::ExitCode::ok};
}

}  // namespace omnimapper::query
