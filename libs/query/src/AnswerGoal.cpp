#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Distance.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/Goal.h>

#include <algorithm>
#include <cmath>

#include "Answers.h"
#include "FoundText.h"
#include "GoalOfRoom.h"
#include "PlaceJson.h"
#include "PlaceText.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

using base::fixed;
using Eigen::Vector2d;

constexpr double kFarthest = 20;  // [m] largest radius and distance

double lengthOf(const Request& request, const std::string& option, double otherwise) {
  const double length = numbersOf(request, option, {otherwise}).front();
  if (length > kFarthest)
    throw base::Error(base::ExitCode::command_line,
                      "--" + option + " is at most " + base::brief(kFarthest) + " m, not " + base::brief(length));
  return length;
}

Vector2d startOf(const MapToAsk& map, const Request& request) {
  const auto from = numbersOf(request, "from", {});
  if (!from.empty()) {
    for (const double coordinate : from) expectInReach(coordinate);
    return {from.at(0), from.at(1)};
  }
  if (!map.places.last_pose)
    throw base::Error(base::ExitCode::command_line,
                      map.file + ": the map has no last pose to start from; give a start with --from X Y");
  return {map.places.last_pose->x, map.places.last_pose->y};
}

/// The landmarks that fit, the nearest to the start first; if there are only near matches, those with the nearest name.
std::vector<NearPlace> targetsOf(const Found& found, const Vector2d& start) {
  std::vector<NearPlace> targets;
  for (const auto& each : found.places) {
    if (each.place->moved || each.match.cost > found.places.front().match.cost) continue;
    if (const auto nearest = nearestPoint(each.place->extent, start))
      targets.push_back({each.place, (*nearest - start).norm()});
  }
  std::stable_sort(targets.begin(), targets.end(),
                   [](const NearPlace& a, const NearPlace& b) { return a.distance < b.distance; });
  return targets;
}

std::string whichText(const std::vector<NearPlace>& targets, std::size_t chosen, const Vector2d& start) {
  const std::string title = titleOf(*targets[chosen].place);
  if (targets.size() == 1) return "goal before " + title + "\n";
  return "goal before " + title + " (" + toString(targets[chosen].place->id) + "), of " +
         std::to_string(targets.size()) + " matches the one nearest to the start " + pointText(start) +
         (chosen == 0 ? "\n" : " with free space before it\n");
}

std::string goalText(const Goal& goal, const GoalOptions& options, const RoomToMove& room) {
  std::string text = "  x " + fixed(goal.x, 3) + " m   y " + fixed(goal.y, 3) + " m   yaw " + fixed(goal.yaw, 4) +
                     " rad (" + fixed(goal.yaw * 180 / M_PI, 1) + " deg)\n  " + fixed(goal.distance, 2) +
                     " m before its edge at " + pointText(goal.edge);
  if (std::abs(goal.distance - options.distance) > 1e-6)
    text += ", because " + base::brief(options.distance) + " m before it is not free";
  text += "\n  free for a robot of " + base::brief(options.radius) + " m radius, ";
  text += goal.is_connected     ? "and reached from the start through free cells"
          : room.isStartKnown() ? "but free cells do not connect it to the start"
                                : "but the start is not in free space: whether it can be reached is not known";
  return text + "\n";
}

Json goalJson(const Goal& goal, const GoalOptions& options, const RoomToMove& room) {
  return {{"x_m", goal.x},
          {"y_m", goal.y},
          {"yaw_rad", goal.yaw},
          {"distance_m", goal.distance},
          {"asked_distance_m", options.distance},
          {"radius_m", options.radius},
          {"edge_m", {goal.edge.x(), goal.edge.y()}},
          {"connected", goal.is_connected     ? Json(true)
                        : room.isStartKnown() ? Json(false)
                                              : Json(nullptr)}};
}

}  // namespace

Answer answerGoal(const MapToAsk& map, const Request& request) {
  const std::string text = textOf(request);
  const Found found = find(map.places.places, text);
  const GoalOptions options{lengthOf(request, "distance", 1), lengthOf(request, "radius", 0.25)};
  const Vector2d start = startOf(map, request);
  Json document = answerTo("goal", map);
  document["text"] = text;
  document["start_m"] = {start.x(), start.y()};
  document["goal"] = nullptr;
  document["target"] = nullptr;
  document["matches"] = matchesJson(found, map, request.brief);
  document["closest"] = found.closest;
  const auto nothing = [&](const std::string& said) {
    return Answer{said, textOf(document), base::ExitCode::nothing_found};
  };
  document["room"] = nullptr;
  if (const auto of_room = goalRoom(map, text)) {
    const GridMap grid = readGrid(map.folder);
    const RoomToMove room(grid, options.radius, start);
    if (auto answer = answerGoalOfRoom(*of_room->room, {room, grid, options.radius}, *map.rooms, document))
      return *answer;
    if (found.places.empty())
      return nothing("a robot of " + base::brief(options.radius) + " m radius fits nowhere in " + titleOf(*of_room) +
                     "\n");
  }
  if (found.places.empty()) return nothing(nothingCalled(text, found));
  const auto targets = targetsOf(found, start);
  if (targets.empty()) return nothing("'" + shownName(text) + "' has moved away: its present place is not known\n");
  const GridMap grid = readGrid(map.folder);
  const RoomToMove room(grid, options.radius, start);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    document["target"] = jsonOf(*targets[i].place, request.brief);
    // A region in which the robot fits nowhere, such as that of two tables, is approached as a landmark is.
    if (auto answer = answerGoalOfRegion(*targets[i].place, {room, grid, options.radius}, document)) return *answer;
    const auto goal = goalBefore(*targets[i].place, start, room, grid, options);
    if (!goal) continue;
    document["goal"] = goalJson(*goal, options, room);
    const std::string said = (found.isOnlyNear() ? foundLine(text, found) : "") + whichText(targets, i, start) +
                             goalText(*goal, options, room) + alignedTable({placeHeads(), cellsOf(*targets[i].place)});
    return {said, textOf(document), base::ExitCode::ok};
  }
  document["target"] = nullptr;
  const auto isInGrid = [&](const NearPlace& target) {
    const auto rim = rimOf(target.place->extent, grid.resolution);
    return std::any_of(rim.begin(), rim.end(), [&](const Vector2d& edge) { return grid.contains(grid.cellOf(edge)); });
  };
  if (std::none_of(targets.begin(), targets.end(), isInGrid))
    return nothing(titleOf(*targets.front().place) +
                   " lies outside the occupancy grid, so the free space before it is not known: map a log in which the "
                   "laser saw that part of the building\n");
  return nothing("no pose " + base::brief(options.distance / 2) + " to " + base::brief(2 * options.distance) +
                 " m before " + titleOf(*targets.front().place) + " is free for a robot of " +
                 base::brief(options.radius) +
                 " m radius and has a line of sight to it; try another --distance or --radius\n");
}

}  // namespace omnimapper::query
