#include "GoalOfRoom.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/Route.h>

#include <cmath>

#include "Target.h"

namespace omnimapper::query {

using base::fixed;
using Eigen::Vector2d;

std::optional<FoundRoom> goalRoom(const MapToAsk& map, const std::string& text) {
  const auto target = targetCalled(map, text);
  if (!target || !target->room) return std::nullopt;
  // Of a room that was only looked into, its sign is the better goal.
  const Found landmarks = find(map.places.places, text);
  if (target->room->isOpen() && !landmarks.places.empty() && !landmarks.isOnlyNear()) return std::nullopt;
  for (const auto& found : findRooms(map, text))
    if (found.room == target->room) return found;
  return std::nullopt;
}

std::optional<Answer> answerGoalOfRoom(const building::Room& target, const RoomToMove& room, const GridMap& grid,
                                       const building::Storey& storey, double radius, Json document) {
  const auto centre = freeCentre(target, room, grid);
  if (!centre) return std::nullopt;
  const auto route = shortestRoute(room, grid, *centre, nullptr);
  double yaw = 0;
  if (route && route->points.size() > 1) {
    constexpr double kArrival = 0.5;  // [m] of the end of the way, which gives the direction
    std::size_t before = route->points.size() - 1;
    while (before > 0 && (route->points[before] - *centre).norm() < kArrival) --before;
    const Vector2d towards = *centre - route->points[before];
    yaw = std::atan2(towards.y(), towards.x());
  }
  const double moved = (*centre - target.centre).norm();
  document["room"] = jsonOf(target, storey);
  document["goal"] = {{"x_m", centre->x()},
                      {"y_m", centre->y()},
                      {"yaw_rad", yaw},
                      {"moved_m", moved},
                      {"radius_m", radius},
                      {"way_m", route ? Json(route->length) : Json(nullptr)},
                      {"connected", route                 ? Json(true)
                                    : room.isStartKnown() ? Json(false)
                                                          : Json(nullptr)}};
  std::string text = "goal in " + titleOf(target) + "\n  x " + fixed(centre->x(), 3) + " m   y " +
                     fixed(centre->y(), 3) + " m   yaw " + fixed(yaw, 4) + " rad (" + fixed(yaw * 180 / M_PI, 1) +
                     " deg)\n  the centre of the room";
  if (moved > grid.resolution) text += ", moved by " + fixed(moved, 2) + " m to where the robot fits";
  text += "\n  free for a robot of " + base::brief(radius) + " m radius, ";
  text += route                 ? "and reached from the start through free cells, " + fixed(route->length, 1) + " m"
          : room.isStartKnown() ? std::string("but free cells do not connect it to the start")
                                : "but the start is not in free space: whether it can be reached is not known";
  return Answer{text + "\n", textOf(document), base::ExitCode::ok};
}

}  // namespace omnimapper::query
