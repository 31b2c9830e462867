#include "GoalOfRoom.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/centroid.h>
#include <omnimapper/map/Labels.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/Route.h>

#include <cmath>
#include <utility>

#include "PlaceText.h"
#include "Target.h"

namespace omnimapper::query {

using base::fixed;
using Eigen::Vector2d;

namespace {

// The goal at the centre of a room or region, which `what` calls so.
std::optional<Answer> answerGoalAtCentre(const building::Room& target, const std::string& title,
                                         const std::string& what, const GoalSpace& space, Json document) {
  const auto centre = freeCentre(target, space.room, space.grid);
  if (!centre) return std::nullopt;
  const auto route = shortestRoute(space.room, space.grid, *centre, nullptr);
  double yaw = 0;
  if (route && route->points.size() > 1) {
    constexpr double kArrival = 0.5;  // [m] of the end of the way, which gives the direction
    std::size_t before = route->points.size() - 1;
    while (before > 0 && (route->points[before] - *centre).norm() < kArrival) --before;
    const Vector2d towards = *centre - route->points[before];
    yaw = std::atan2(towards.y(), towards.x());
  }
  const double moved = (*centre - target.centre).norm();
  document["goal"] = {{"x_m", centre->x()},
                      {"y_m", centre->y()},
                      {"yaw_rad", yaw},
                      {"moved_m", moved},
                      {"radius_m", space.radius},
                      {"way_m", route ? Json(route->length) : Json(nullptr)},
                      {"connected", route                       ? Json(true)
                                    : space.room.isStartKnown() ? Json(false)
                                                                : Json(nullptr)}};
  std::string text = "goal in " + title + "\n  x " + fixed(centre->x(), 3) + " m   y " + fixed(centre->y(), 3) +
                     " m   yaw " + fixed(yaw, 4) + " rad (" + fixed(yaw * 180 / M_PI, 1) +
                     " deg)\n  the centre of the " + what;
  if (moved > space.grid.resolution) text += ", moved by " + fixed(moved, 2) + " m to where the robot fits";
  text += "\n  free for a robot of " + base::brief(space.radius) + " m radius, ";
  text += route ? "and reached from the start through free cells, " + fixed(route->length, 1) + " m"
          : space.room.isStartKnown() ? std::string("but free cells do not connect it to the start")
                                      : "but the start is not in free space: whether it can be reached is not known";
  return Answer{text + "\n", textOf(document), base::ExitCode::ok};
}

}  // namespace

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

std::optional<Answer> answerGoalOfRoom(const building::Room& target, const GoalSpace& space,
                                       const building::Storey& storey, Json document) {
  document["room"] = jsonOf(target, storey);
  return answerGoalAtCentre(target, titleOf(target), "room", space, std::move(document));
}

std::optional<building::Room> roomOfRegion(const map::Place& place) {
  if (place.kind != map::Labels::kRegion || place.extent.outlines.empty()) return std::nullopt;
  building::Room room;
  room.outline = place.extent.outlines.front();
  const auto centre = geometry::centroid(room.outline);
  if (!centre) return std::nullopt;
  room.centre = *centre;
  return room;
}

std::optional<Answer> answerGoalOfRegion(const map::Place& target, const GoalSpace& space, Json document) {
  const auto room = roomOfRegion(target);
  if (!room) return std::nullopt;
  return answerGoalAtCentre(*room, titleOf(target), "region", space, std::move(document));
}

}  // namespace omnimapper::query
