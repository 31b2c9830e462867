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

namespace omnimapper::query {

namespace {

constexpr std::size_t kMostLines = 40;  // largest number of places in the text of an answer; its JSON has all

using Lines = std::vector<std::vector<std::string>>;

std::vector<std::string> withFirst(const std::string& first, std::vector<std::string> cells) {
  cells.insert(cells.begin(), first);
  return cells;
}

std::string tableOf(Lines lines) {
  const std::size_t count = lines.size() - 1;
  if (count > kMostLines) lines.resize(kMostLines + 1);
  return alignedTable(lines) +
         (count > kMostLines ? "  and " + std::to_string(count - kMostLines) + " more: --json has them all\n" : "");
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
  const std::string text = textOf(request);
  const Found found = find(map.places.places, text);
  Json document = answerTo("find", map);
  document["text"] = text;
  document["matches"] = matchesJson(found);
  document["closest"] = found.closest;
  if (found.places.empty()) return {nothingCalled(text, found), textOf(document), base::ExitCode::nothing_found};
  Lines lines{withFirst("match", placeHeads())};
  for (const auto& each : found.places) lines.push_back(withFirst(toString(each.match.grade), cellsOf(*each.place)));
  return {foundLine(text, found) + tableOf(lines), textOf(document), base::ExitCode::ok};
}

Answer answerNear(const MapToAsk& map, const Request& request) {
  constexpr std::size_t kFew = 5;
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d point(coordinateOf(request.words.at(0)), coordinateOf(request.words.at(1)));
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
    Json place = jsonOf(*each.place);
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
    document["places"].push_back(jsonOf(*place));
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
