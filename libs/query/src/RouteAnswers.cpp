#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Segment2.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/RoomsAsked.h>
#include <omnimapper/query/Route.h>

#include <algorithm>
#include <set>

#include "Answers.h"
#include "PlaceJson.h"
#include "PlaceText.h"
#include "RoomAnswers.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

using base::fixed;
using Eigen::Vector2d;
using Lines = std::vector<std::vector<std::string>>;

/// The two ends of a question, or why there is no answer.
struct Ends {
  std::optional<Target> from, to;
  std::string missing;  // a sentence; empty if both are known
};

Ends endsOf(const MapToAsk& map, const std::pair<std::string, std::string>& texts, Json& document) {
  Ends ends{targetCalled(map, texts.first), targetCalled(map, texts.second), ""};
  document["from"] = ends.from ? jsonOf(*ends.from) : Json(nullptr);
  document["to"] = ends.to ? jsonOf(*ends.to) : Json(nullptr);
  for (const auto& [text, target] : {std::pair(texts.first, ends.from), std::pair(texts.second, ends.to)})
    if (!target && ends.missing.empty()) ends.missing = "nothing is called '" + shownName(text) + "' or similarly\n";
  return ends;
}

/// A route between two targets; none with the reason.
struct Way {
  std::optional<Route> route;
  std::string why_not;
};

Way wayBetween(const Ends& ends, const MapToAsk& map, double radius) {
  const GridMap grid = readGrid(map.folder);
  // A room may have pockets that no robot gets into, as between the legs of a table. The last pose is in none.
  const auto& last = map.places.last_pose;
  const RoomToMove anywhere(grid, radius, last ? Vector2d(last->x, last->y) : ends.from->position);
  const auto start = standAt(*ends.from, ends.to->position, anywhere, grid);
  if (!start) return {std::nullopt, ends.from->title};
  const RoomToMove room(grid, radius, *start);
  if (!room.isStartKnown()) return {std::nullopt, ends.from->title};
  const auto end = standAt(*ends.to, *start, room, grid);
  if (!end) return {std::nullopt, ends.to->title};
  return {shortestRoute(room, grid, *end, map.rooms ? &*map.rooms : nullptr), ""};
}

std::string doorText(const building::Door* door) {
  return door ? "door " + std::to_string(door->id) : "";
}

Json passedJson(const Route& route) {
  Json rooms = Json::array();
  for (const auto& passed : route.rooms) {
    Json json = briefJson(passed.room);
    json["through"] = passed.door ? Json(doorText(passed.door)) : Json(nullptr);
    rooms.push_back(std::move(json));
  }
  return rooms;
}

// Some points of the way, at most `step` [m] apart.
Json pointsJson(const Route& route, double step) {
  Json points = Json::array();
  double since = step;
  for (std::size_t i = 0; i < route.points.size(); ++i) {
    if (i > 0) since += (route.points[i] - route.points[i - 1]).norm();
    if (since < step && i + 1 < route.points.size()) continue;
    points.push_back({route.points[i].x(), route.points[i].y()});
    since = 0;
  }
  return points;
}

std::string passedText(const Route& route) {
  std::string text;
  for (const auto& passed : route.rooms)
    text += "  " +
            (passed.door ? "through " + doorText(passed.door) + " to " : std::string(text.empty() ? "from " : "to ")) +
            titleOf(*passed.room) + "\n";
  return text;
}

double radiusOf(const Request& request) {
  constexpr double kUsual = 0.25, kMost = 20;  // [m]
  const double radius = numbersOf(request, "radius", {kUsual}).front();
  if (radius > kMost)
    throw base::Error(base::ExitCode::command_line, "--radius is at most " + base::brief(kMost) + " m");
  return radius;
}

}  // namespace

Answer answerPath(const MapToAsk& map, const Request& request) {
  const double radius = radiusOf(request);
  Json document = answerTo("path", map);
  const Ends ends = endsOf(map, twoTexts(request.words, "to"), document);
  document["length_m"] = nullptr;
  document["rooms"] = document["points_m"] = Json::array();
  document["radius_m"] = radius;
  const auto nothing = [&](const std::string& said) {
    return Answer{said, textOf(document), base::ExitCode::nothing_found};
  };
  if (!ends.missing.empty()) return nothing(ends.missing);
  const Way way = wayBetween(ends, map, radius);
  if (!way.why_not.empty())
    return nothing("no place at " + way.why_not + " is free for a robot of " + base::brief(radius) + " m radius\n");
  if (!way.route)
    return nothing("free cells do not connect " + ends.from->title + " and " + ends.to->title + " for a robot of " +
                   base::brief(radius) + " m radius\n");
  document["length_m"] = way.route->length;
  document["rooms"] = passedJson(*way.route);
  constexpr double kStep = 0.5;  // [m]
  document["points_m"] = pointsJson(*way.route, kStep);
  return {"from " + ends.from->title + " to " + ends.to->title + ": " + fixed(way.route->length, 1) + " m\n" +
              passedText(*way.route),
          textOf(document), base::ExitCode::ok};
}

Answer answerBetween(const MapToAsk& map, const Request& request) {
  constexpr double kBeside = 1;  // [m] from the straight line
  Json document = answerTo("between", map);
  const Ends ends = endsOf(map, twoTexts(request.words, "and"), document);
  document["doors"] = document["rooms"] = document["places"] = Json::array();
  if (!ends.missing.empty()) return {ends.missing, textOf(document), base::ExitCode::nothing_found};
  std::string text;
  if (map.rooms && ends.from->room && ends.to->room) {
    for (const auto& door : map.rooms->doors) {
      if (std::set<int>{door.rooms[0], door.rooms[1]} != std::set<int>{ends.from->room->id, ends.to->room->id})
        continue;
      document["doors"].push_back(doorText(&door));
      text += "  " + doorText(&door) + " at " + fixed(geometry::middle(door.opening).x(), 2) + " " +
              fixed(geometry::middle(door.opening).y(), 2) + " joins them\n";
    }
  }
  if (map.rooms) {
    const Way way = wayBetween(ends, map, radiusOf(request));
    const auto passed = way.route ? way.route->rooms : std::vector<Route::Passed>();
    for (std::size_t i = 1; i + 1 < passed.size(); ++i) {
      document["rooms"].push_back(briefJson(passed[i].room));
      text += "  " + titleOf(*passed[i].room) + " is on the way\n";
    }
  }
  const geometry::Segment2 line{ends.from->position, ends.to->position};
  std::vector<std::pair<double, const map::Place*>> places;
  for (const auto& place : map.places.places) {
    const Vector2d at = place.position.head<2>();
    const double along = (at - line.from).dot(direction(line));
    const bool is_end = &place == ends.from->place || &place == ends.to->place;
    if (place.moved || is_end || along <= 0 || along >= length(line) || distance(line, at) > kBeside) continue;
    places.emplace_back(along, &place);
  }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second->id) < std::tie(b.first, b.second->id);
  });
  Lines lines{placeHeads()};
  for (const auto& [along, place] : places) {
    lines.push_back(cellsOf(*place));
    document["places"].push_back(jsonOf(*place, request.brief));
  }
  if (lines.size() > 1) text += tableOf(lines);
  if (text.empty())
    return {"nothing is known between " + ends.from->title + " and " + ends.to->title + "\n", textOf(document),
            base::ExitCode::nothing_found};
  return {"between " + ends.from->title + " and " + ends.to->title + ":\n" + text, textOf(document),
          base::ExitCode::ok};
}

}  // namespace omnimapper::query
