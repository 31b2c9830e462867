#include <omnimapper/building/Continuation.h>
#include <omnimapper/building/RoomsOfCells.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace omnimapper::building {

namespace {

/// Number of cells that an earlier room and a room of now have in common.
struct Overlap {
  int cells = 0, earlier = 0, now = 0;
};

/// All overlaps, the largest first.
std::vector<Overlap> overlapsOf(const std::vector<std::int32_t>& earlier, const std::vector<std::int32_t>& now) {
  std::map<std::pair<int, int>, int> counts;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (const int id = earlier[i]; id != 0 && now[i] != 0) ++counts[{id, now[i]}];
  std::vector<Overlap> overlaps;
  for (const auto& [ids, cells] : counts) overlaps.push_back({cells, ids.first, ids.second});
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const Overlap& a, const Overlap& b) { return a.cells > b.cells; });
  return overlaps;
}

/// New ids of the rooms of now, by their present ones.
std::map<int, int> newIds(const std::vector<Overlap>& overlaps, Storey& now, int next) {
  std::map<int, int> ids;
  std::set<int> taken;
  for (const Overlap& overlap : overlaps)
    if (ids.count(overlap.now) == 0 && taken.insert(overlap.earlier).second) ids[overlap.now] = overlap.earlier;
  for (const Room& room : now.rooms)
    if (ids.count(room.id) == 0) ids[room.id] = next++;
  now.next_room = next;
  return ids;
}

void noteSplits(const std::vector<Overlap>& overlaps, const std::map<int, int>& ids, double cell, Storey& now) {
  for (Room& room : now.rooms) {
    if (room.split_from && ids.count(*room.split_from) > 0) room.split_from = ids.at(*room.split_from);
    const auto largest =
        std::find_if(overlaps.begin(), overlaps.end(), [&](const Overlap& overlap) { return overlap.now == room.id; });
    if (largest == overlaps.end() || ids.at(room.id) == largest->earlier) continue;
    if (2 * largest->cells * cell * cell >= room.area) room.split_from = largest->earlier;
  }
}

void renumber(const std::map<int, int>& ids, Segmentation& now) {
  for (auto& id : now.room_of_cell)
    if (id != 0) id = ids.at(id);
  for (Room& room : now.storey.rooms) {
    room.id = ids.at(room.id);
    for (int& id : room.neighbours) id = ids.at(id);
    std::sort(room.neighbours.begin(), room.neighbours.end());
  }
  for (Door& door : now.storey.doors) {
    for (int& id : door.rooms) id = ids.at(id);
    std::sort(door.rooms.begin(), door.rooms.end());
  }
  std::sort(now.storey.rooms.begin(), now.storey.rooms.end(), [](const Room& a, const Room& b) { return a.id < b.id; });
}

void renumberDoors(const Storey& earlier, Storey& now) {
  constexpr double kSame = 0.5;  // [m]
  std::set<int> taken;
  now.next_door = earlier.next_door;
  for (Door& door : now.doors) {
    const Door* nearest = nullptr;
    double smallest = kSame;
    for (const Door& other : earlier.doors) {
      const double distance = (geometry::middle(other.opening) - geometry::middle(door.opening)).norm();
      if (other.rooms != door.rooms || taken.count(other.id) > 0 || distance >= smallest) continue;
      smallest = distance;
      nearest = &other;
    }
    door.id = nearest != nullptr ? nearest->id : now.next_door++;
    taken.insert(door.id);
  }
  std::sort(now.doors.begin(), now.doors.end(), [](const Door& a, const Door& b) { return a.id < b.id; });
}

// A room that keeps its id keeps what was known of it, too, unless a user has named it since.
void keepNames(const Storey& earlier, Storey& now) {
  for (Room& room : now.rooms) {
    const Room* before = roomOf(earlier, room.id);
    if (before == nullptr || isNamedByUser(room)) continue;
    room.name = before->name;
    room.name_confidence = before->name_confidence;
    room.kind = before->kind;
    room.kind_confidence = before->kind_confidence;
    room.why = before->why;
  }
}

}  // namespace

Continuation continueRooms(const Storey& earlier, const grid::GridMap& grid, Segmentation now) {
  const auto overlaps = overlapsOf(roomsOfCells(earlier, grid), now.room_of_cell);
  const auto ids = newIds(overlaps, now.storey, earlier.next_room);
  noteSplits(overlaps, ids, grid.resolution, now.storey);
  renumber(ids, now);
  renumberDoors(earlier, now.storey);
  now.storey.id = earlier.id;
  keepNames(earlier, now.storey);
  Continuation result{std::move(now), {}};
  const auto& rooms = result.now.storey.rooms;
  for (const Room& room : earlier.rooms)
    if (std::none_of(rooms.begin(), rooms.end(), [&](const Room& each) { return each.id == room.id; }))
      result.gone.push_back(room.id);
  return result;
}

}  // namespace omnimapper::building
