#include <omnimapper/building/Storey.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace omnimapper::building {

namespace {

using Loop = std::vector<Eigen::Vector2d>;

// By the even-odd rule.
bool isInside(const Loop& loop, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Eigen::Vector2d &a = loop[i], &b = loop[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double distanceTo(const Room& room, const Eigen::Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = room.outline.size() - 1; i < room.outline.size(); j = i++)
    least = std::min(least, geometry::distance({room.outline[j], room.outline[i]}, point));
  return least;
}

void moveBy(const geometry::Se2& now_from_then, Room& room) {
  for (auto& corner : room.outline) corner = now_from_then * corner;
  for (auto& hole : room.holes)
    for (auto& corner : hole) corner = now_from_then * corner;
  room.centre = now_from_then * room.centre;
}

}  // namespace

std::string toString(NameEvidence::Source source) {
  switch (source) {
    case NameEvidence::Source::sign:
      return "sign";
    case NameEvidence::Source::contents:
      return "contents";
    case NameEvidence::Source::user:
      break;
  }
  return "user";
}

std::string nameOf(const Room& room) {
  if (!room.name.empty()) return room.name;
  if (!room.kind.empty() && room.kind_confidence >= kSureKind) return room.kind;
  return "room " + std::to_string(room.id);
}

bool isNamedByUser(const Room& room) {
  return !room.name.empty() && std::any_of(room.why.begin(), room.why.end(), [](const NameEvidence& each) {
    return each.source == NameEvidence::Source::user;
  });
}

std::string labelOf(const Room& room) {
  const std::string name = nameOf(room), number = std::to_string(room.id);
  return name == "room " + number ? number : name + " (" + number + ")";
}

bool contains(const Room& room, const Eigen::Vector2d& point) {
  return isInside(room.outline, point) &&
         std::none_of(room.holes.begin(), room.holes.end(), [&](const Loop& hole) { return isInside(hole, point); });
}

const Room* roomAt(const Storey& storey, const Eigen::Vector2d& point) {
  for (const Room& room : storey.rooms)
    if (contains(room, point)) return &room;
  return nullptr;
}

std::optional<NearRoom> nearestRoom(const Storey& storey, const Eigen::Vector2d& point) {
  if (const Room* room = roomAt(storey, point)) return NearRoom{room, 0};
  std::optional<NearRoom> nearest;
  for (const Room& room : storey.rooms)
    if (const double distance = distanceTo(room, point); !nearest || distance < nearest->distance)
      nearest = NearRoom{&room, distance};
  return nearest;
}

const Room* roomOfThing(const Storey& storey, const Eigen::Vector2d& middle,
                        const std::optional<Eigen::Vector2d>& free_side) {
  constexpr double kLevel = 0.5;                                 // of the length of a direction in space
  constexpr std::array<double, 4> kSteps{0.15, 0.3, 0.5, 0.75};  // [m] from a wall, whose thickness is not known
  if (free_side && free_side->norm() > kLevel)
    for (const double step : kSteps)
      if (const Room* room = roomAt(storey, middle + step * free_side->normalized())) return room;
  constexpr double kBeside = 1;  // [m] half of a bed, whose middle is no free space
  const auto near = nearestRoom(storey, middle);
  return near && near->distance <= kBeside ? near->room : nullptr;
}

const Room* roomOf(const Storey& storey, int id) {
  for (const Room& room : storey.rooms)
    if (room.id == id) return &room;
  return nullptr;
}

Storey movedWith(Storey storey, const MapFromFrame& now) {
  std::map<int, geometry::Se2> now_from_then;
  for (Room& room : storey.rooms) {
    if (!room.anchor) continue;
    const auto map_from_frame = now(room.anchor->frame);
    if (!map_from_frame) continue;
    const geometry::Se2 change = *map_from_frame * inverse(room.anchor->map_from_frame);
    now_from_then[room.id] = change;
    moveBy(change, room);
    room.anchor->map_from_frame = *map_from_frame;
  }
  for (Door& door : storey.doors) {
    const auto change = now_from_then.find(door.rooms[0]);
    if (change == now_from_then.end()) continue;
    door.opening = {change->second * door.opening.from, change->second * door.opening.to};
  }
  for (UnseenRoom& unseen : storey.unseen) {
    const auto change = now_from_then.find(unseen.seen_from.value_or(0));
    if (change != now_from_then.end()) unseen.door = change->second * unseen.door;
  }
  return storey;
}

}  // namespace omnimapper::building
