#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomEdits.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <set>

#include "Outline.h"

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;

Room* roomNear(Segmentation& rooms, const Vector2d& point) {
  constexpr double kNear = 0.5;  // [m]
  const auto near = nearestRoom(rooms.storey, point);
  if (!near || near->distance > kNear) return nullptr;
  return &*std::find_if(rooms.storey.rooms.begin(), rooms.storey.rooms.end(),
                        [&](const Room& room) { return room.id == near->room->id; });
}

std::string placeText(const Vector2d& point) {
  return base::fixed(point.x(), 2) + " " + base::fixed(point.y(), 2);
}

std::string noRoomAt(const Vector2d& point) {
  return "there is no room at " + placeText(point);
}

// Sets area and shape of a room by the cells that have its id.
void measure(const grid::GridMap& grid, const Segmentation& rooms, Room& room) {
  cv::Mat labels(grid.rows, grid.columns, CV_32S, const_cast<std::int32_t*>(rooms.room_of_cell.data()));
  const cv::Mat mask = labels == room.id;
  const cv::Rect box = cv::boundingRect(mask);
  FreeSpace space;
  space.cell = grid.resolution;
  room.area = cv::countNonZero(mask) * grid.resolution * grid.resolution;
  room.holes.clear();
  outline(space, grid.map_from_grid, mask(box), box.tl() + cv::Point(FreeSpace::kMargin, FreeSpace::kMargin), room);
}

// After rooms or doors changed.
void findNeighbours(Storey& storey) {
  for (Room& room : storey.rooms) {
    std::set<int> neighbours;
    for (const Door& door : storey.doors)
      for (const int side : {0, 1})
        if (door.rooms[side] == room.id) neighbours.insert(door.rooms[1 - side]);
    room.neighbours.assign(neighbours.begin(), neighbours.end());
  }
}

std::string rename(const RoomEdit& edit, Segmentation& rooms) {
  Room* room = roomNear(rooms, edit.points[0]);
  if (!room) return noRoomAt(edit.points[0]);
  room->name = edit.name;
  room->name_confidence = 1;
  room->why.erase(std::remove_if(room->why.begin(), room->why.end(),
                                 [](const NameEvidence& each) { return each.source == NameEvidence::Source::user; }),
                  room->why.end());
  room->why.insert(room->why.begin(), {NameEvidence::Source::user, "named '" + edit.name + "' by a user", 1});
  return "";
}

std::string remove(const RoomEdit& edit, Segmentation& rooms) {
  // The point itself must be in the room: if the room is gone already, its neighbour must not go, too.
  const Room* room = roomAt(rooms.storey, edit.points[0]);
  if (!room) return noRoomAt(edit.points[0]);
  const int id = room->id;
  Storey& storey = rooms.storey;
  std::replace(rooms.room_of_cell.begin(), rooms.room_of_cell.end(), id, 0);
  storey.rooms.erase(
      std::remove_if(storey.rooms.begin(), storey.rooms.end(), [&](const Room& each) { return each.id == id; }),
      storey.rooms.end());
  storey.doors.erase(std::remove_if(storey.doors.begin(), storey.doors.end(),
                                    [&](const Door& door) { return door.rooms[0] == id || door.rooms[1] == id; }),
                     storey.doors.end());
  findNeighbours(storey);
  return "";
}

std::string merge(const RoomEdit& edit, const grid::GridMap& grid, Segmentation& rooms) {
  Room *kept = roomNear(rooms, edit.points[0]), *other = roomNear(rooms, edit.points[1]);
  if (!kept || !other) return noRoomAt(edit.points[kept ? 1 : 0]);
  if (kept == other) return "both points are in room " + std::to_string(kept->id);
  if (std::count(kept->neighbours.begin(), kept->neighbours.end(), other->id) == 0)
    return "no door joins room " + std::to_string(kept->id) + " and room " + std::to_string(other->id);
  if (other->id < kept->id) std::swap(kept, other);
  const int id = kept->id, gone = other->id;
  if (kept->name.empty() || (isNamedByUser(*other) && !isNamedByUser(*kept))) {
    kept->name = other->name;
    kept->name_confidence = other->name_confidence;
  }
  kept->why.insert(kept->why.end(), other->why.begin(), other->why.end());
  kept->openness = (kept->openness * kept->area + other->openness * other->area) / (kept->area + other->area);
  kept->confidence = 1;
  std::replace(rooms.room_of_cell.begin(), rooms.room_of_cell.end(), gone, id);
  // The cells of the door between them join both parts.
  cv::Mat labels(grid.rows, grid.columns, CV_32S, rooms.room_of_cell.data());
  for (const Door& door : rooms.storey.doors) {
    if (std::set<int>{door.rooms[0], door.rooms[1]} != std::set<int>{id, gone}) continue;
    const Eigen::Vector2i from = grid.cellOf(door.opening.from), to = grid.cellOf(door.opening.to);
    const int width = std::max(1, static_cast<int>(0.3 / grid.resolution));  // [m] as thick as a wall
    cv::line(labels, {from.x(), from.y()}, {to.x(), to.y()}, id, width);
  }
  measure(grid, rooms, *kept);
  Storey& storey = rooms.storey;
  storey.rooms.erase(
      std::find_if(storey.rooms.begin(), storey.rooms.end(), [&](const Room& each) { return each.id == gone; }));
  for (Door& door : storey.doors) {
    std::replace(door.rooms.begin(), door.rooms.end(), gone, id);
    std::sort(door.rooms.begin(), door.rooms.end());
  }
  storey.doors.erase(std::remove_if(storey.doors.begin(), storey.doors.end(),
                                    [](const Door& door) { return door.rooms[0] == door.rooms[1]; }),
                     storey.doors.end());
  findNeighbours(storey);
  return "";
}

// The parts of a room on both sides of a line, the largest first; the cells of the line belong to none.
std::vector<cv::Mat> partsOf(const cv::Mat& mask, const grid::GridMap& grid, const RoomEdit& edit) {
  constexpr double kBeyond = 0.3;  // [m] the ends may be this far from the walls
  const Vector2d along = (edit.points[1] - edit.points[0]).normalized();
  const Eigen::Vector2i from = grid.cellOf(edit.points[0] - kBeyond * along),
                        to = grid.cellOf(edit.points[1] + kBeyond * along);
  cv::Mat cut = mask.clone(), numbers;
  cv::line(cut, {from.x(), from.y()}, {to.x(), to.y()}, 0, 1, cv::LINE_4);
  const int count = cv::connectedComponents(cut, numbers, 4);
  std::vector<cv::Mat> parts;
  for (int number = 1; number < count; ++number) parts.push_back(numbers == number);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a) > cv::countNonZero(b); });
  return parts;
}

// The doors of a room that was split are those of the part on whose side they are.
void giveDoors(Storey& storey, int room, const Room& part) {
  Storey parts;
  parts.rooms = {part, *roomOf(storey, room)};
  for (Door& door : storey.doors) {
    for (int& side : door.rooms) {
      if (side != room) continue;
      const auto near = nearestRoom(parts, geometry::middle(door.opening));
      if (near && near->room->id == part.id) side = part.id;
    }
    std::sort(door.rooms.begin(), door.rooms.end());
  }
}

std::string split(const RoomEdit& edit, const grid::GridMap& grid, Segmentation& rooms) {
  constexpr double kLeastPart = 0.5;  // [m^2]
  constexpr double kBehindWalls = 2;  // [m] the line may end this far outside of all rooms
  const Vector2d middle = 0.5 * (edit.points[0] + edit.points[1]);
  Room* room = roomNear(rooms, middle);
  if (!room) return noRoomAt(middle);
  if ((edit.points[1] - edit.points[0]).norm() < grid.resolution) return "the line has no length";
  for (const Vector2d& end : edit.points)
    if (!(nearestRoom(rooms.storey, end)->distance <= kBehindWalls))
      return "the line ends at " + placeText(end) + ", far outside of all rooms: begin and end it at walls";
  cv::Mat labels(grid.rows, grid.columns, CV_32S, rooms.room_of_cell.data());
  const auto parts = partsOf(labels == room->id, grid, edit);
  const double cell_area = grid.resolution * grid.resolution;
  if (parts.size() < 2 || cv::countNonZero(parts[1]) * cell_area < kLeastPart)
    return "the line at " + placeText(middle) + " does not cut room " + std::to_string(room->id) +
           " in two: begin and end it at walls";
  const int id = room->id;
  Storey& storey = rooms.storey;
  Room fresh = *room;
  fresh.id = storey.next_room++;
  fresh.name.clear();
  fresh.why.clear();
  fresh.name_confidence = 0;
  fresh.split_from = id;
  labels.setTo(fresh.id, parts[1]);
  measure(grid, rooms, *room);
  measure(grid, rooms, fresh);
  giveDoors(storey, id, fresh);
  Door door;
  door.id = storey.next_door++;
  door.confidence = 1;
  door.opening = {edit.points[0], edit.points[1]};
  door.width = length(door.opening);
  door.rooms = {std::min(id, fresh.id), std::max(id, fresh.id)};
  storey.doors.push_back(door);
  storey.rooms.push_back(fresh);
  findNeighbours(storey);
  return "";
}

std::string moveDoor(const RoomEdit& edit, Segmentation& rooms) {
  constexpr double kNear = 1, kWidest = 20, kMoved = 5;  // [m]
  Door* nearest = nullptr;
  double least = kNear;
  for (Door& door : rooms.storey.doors)
    if (const double distance = geometry::distance(door.opening, edit.points[0]); distance <= least) {
      least = distance;
      nearest = &door;
    }
  if (!nearest) return "there is no door at " + placeText(edit.points[0]);
  const geometry::Segment2 opening{edit.points[1], edit.points[2]};
  if (!(length(opening) <= kWidest)) return "a door is at most " + base::brief(kWidest) + " m wide";
  if (!(geometry::distance(nearest->opening, geometry::middle(opening)) <= kMoved))
    return "a door moves by at most " + base::brief(kMoved) + " m, and this one is at " +
           placeText(geometry::middle(nearest->opening));
  nearest->opening = opening;
  nearest->width = length(opening);
  nearest->confidence = 1;
  return "";
}

}  // namespace

std::string applyEdit(const RoomEdit& edit, const grid::GridMap& grid, Segmentation& rooms) {
  switch (edit.kind) {
    case RoomEdit::Kind::rename:
      return rename(edit, rooms);
    case RoomEdit::Kind::merge:
      return merge(edit, grid, rooms);
    case RoomEdit::Kind::split:
      return split(edit, grid, rooms);
    case RoomEdit::Kind::remove:
      return remove(edit, rooms);
    case RoomEdit::Kind::move_door:
      break;
  }
  return moveDoor(edit, rooms);
}

}  // namespace omnimapper::building
