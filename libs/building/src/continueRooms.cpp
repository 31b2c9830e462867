#include <omnimapper/building/Continuation.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <tuple>

namespace omnimapper::building {

namespace {

/// Number of cells that an earlier room and a room of now have in common.
struct Overlap {
  int cells = 0, earlier = 0, now = 0;
};

/// The id of the earlier room at each cell of the grid; 0 for none.
cv::Mat earlierRooms(const Storey& earlier, const grid::GridMap& grid) {
  cv::Mat rooms = cv::Mat::zeros(grid.rows, grid.columns, CV_32S);
  // Drawing takes as long as an outline is high, so corners far outside are drawn closer.
  const Eigen::Vector2i size(grid.columns, grid.rows);
  for (const Room& room : earlier.rooms) {
    std::vector<std::vector<cv::Point>> loops;
    const auto add = [&](const std::vector<Eigen::Vector2d>& corners) {
      auto& loop = loops.emplace_back();
      for (const Eigen::Vector2d& corner : corners) {
        const Eigen::Vector2i cell = grid.cellOf(corner).cwiseMax(-size).cwiseMin(2 * size);
        loop.emplace_back(cell.x(), cell.y());
      }
    };
    add(room.outline);
    for (const auto& hole : room.holes) add(hole);
    cv::fillPoly(rooms, loops, room.id);
  }
  return rooms;
}

/// All overlaps, the largest first.
std::vector<Overlap> overlapsOf(const cv::Mat& earlier, const std::vector<std::int32_t>& now) {
  std::map<std::pair<int, int>, int> counts;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (const int id = earlier.ptr<int>()[i]; id != 0 && now[i] != 0) ++counts[{id, now[i]}];
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

}  // namespace

Continuation continueRooms(const Storey& earlier, const grid::GridMap& grid, Segmentation now) {
  const auto overlaps = overlapsOf(earlierRooms(earlier, grid), now.room_of_cell);
  const auto ids = newIds(overlaps, now.storey, earlier.next_room);
  noteSplits(overlaps, ids, grid.resolution, now.storey);
  renumber(ids, now);
  renumberDoors(earlier, now.storey);
  now.storey.id = earlier.id;
  Continuation result{std::move(now), {}};
  const auto& rooms = result.now.storey.rooms;
  for (const Room& room : earlier.rooms)
    if (std::none_of(rooms.begin(), rooms.end(), [&](const Room& each) { return each.id == room.id; }))
      result.gone.push_back(room.id);
  return result;
}

}  // namespace omnimapper::building
