#include <omnimapper/query/Route.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace omnimapper::query {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;

/// The cells from a start to an end, by Dijkstra's algorithm from the end.
std::vector<Vector2i> cellsBetween(const RoomToMove& room, const GridMap& grid, const Vector2i& from,
                                   const Vector2i& to) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> to_go(grid.cells.size(), kFar);
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto cellAt = [&](std::size_t index) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    return Vector2i(static_cast<int>(index % columns), static_cast<int>(index / columns));
  };
  const auto forEachNeighbour = [&](const Vector2i& cell, const auto& visit) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const Vector2i next = cell + Vector2i(dx, dy); (dx != 0 || dy != 0) && room.isReached(next))
          visit(next, dx != 0 && dy != 0 ? std::sqrt(2.0F) : 1.0F);
  };
  const std::size_t start = grid.indexOf(from);
  to_go[grid.indexOf(to)] = 0;
  open.push({0.0F, grid.indexOf(to)});
  while (!open.empty() && open.top().second != start) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > to_go[index]) continue;
    const float so_far = cost;
    forEachNeighbour(cellAt(index), [&](const Vector2i& next, float step) {
      float& known = to_go[grid.indexOf(next)];
      if (so_far + step >= known) return;
      known = so_far + step;
      open.push({known, grid.indexOf(next)});
    });
  }
  std::vector<Vector2i> cells;
  if (!(to_go[start] < kFar)) return cells;
  cells.push_back(from);
  while (cells.back() != to) {
    Vector2i best = cells.back();
    float least = kFar;
    forEachNeighbour(cells.back(), [&](const Vector2i& next, float step) {
      const float through = to_go[grid.indexOf(next)] + step;
      if (through >= least) return;
      least = through;
      best = next;
    });
    cells.push_back(best);
  }
  return cells;
}

const building::Door* doorBetween(const building::Storey& storey, int from, int to, const Vector2d& at) {
  const building::Door* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& door : storey.doors) {
    const bool joins = door.rooms[0] == std::min(from, to) && door.rooms[1] == std::max(from, to);
    const double distance = geometry::distance(door.opening, at);
    if (!joins || distance >= least) continue;
    least = distance;
    nearest = &door;
  }
  return nearest;
}

// Stretches of a few cells that are nearer to another room than their door are no visit to it.
std::vector<Route::Passed> roomsAlong(const std::vector<Vector2d>& points, const building::Storey& storey,
                                      double cell) {
  constexpr double kVisit = 0.4;  // [m]
  std::vector<Route::Passed> passed;
  const auto least = static_cast<std::size_t>(kVisit / cell);
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const auto* room = roomAt(storey, points[begin]);
    for (end = begin + 1; end < points.size() && (!room || building::contains(*room, points[end]));) {
      if (!room && roomAt(storey, points[end])) break;
      ++end;
    }
    const bool is_visit = end - begin >= least || begin == 0 || end == points.size();
    if (!room || !is_visit || (!passed.empty() && passed.back().room == room)) continue;
    const auto* door = passed.empty() ? nullptr : doorBetween(storey, passed.back().room->id, room->id, points[begin]);
    passed.push_back({room, door});
  }
  return passed;
}

// The cell nearest to a point for which `fits` is true, within `most` [m].
template <class Fits>
std::optional<Vector2i> nearestCell(const GridMap& grid, const Vector2d& point, double most, const Fits& fits) {
  const Vector2i middle = grid.cellOf(point);
  // Rooms are as large as their documents say, which may be wrong: nothing outside of the grid is searched.
  const auto reach = static_cast<int>(std::min(std::ceil(most / grid.resolution), 1e9));
  const Vector2i low = (middle.array() - reach).max(0), size(grid.columns, grid.rows),
                 high = (middle.array() + reach).min(size.array() - 1);
  std::optional<Vector2i> nearest;
  double least = most;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const Vector2i cell(x, y);
      const double distance = (grid.middleOf(cell) - point).norm();
      if (distance > least || (nearest && distance == least) || !fits(cell)) continue;
      least = distance;
      nearest = cell;
    }
  }
  return nearest;
}

}  // namespace

std::optional<Route> shortestRoute(const RoomToMove& room, const GridMap& grid, const Vector2d& to,
                                   const building::Storey* storey) {
  constexpr double kNear = 0.5;  // [m]
  const auto isReached = [&](const Vector2i& cell) { return room.isReached(cell); };
  const auto end = nearestCell(grid, to, kNear, isReached);
  if (!room.start() || !end) return std::nullopt;
  Route route;
  const auto cells = cellsBetween(room, grid, *room.start(), *end);
  if (cells.empty()) return std::nullopt;
  for (const auto& cell : cells) route.points.push_back(grid.middleOf(cell));
  for (std::size_t i = 1; i < route.points.size(); ++i) route.length += (route.points[i] - route.points[i - 1]).norm();
  if (storey) route.rooms = roomsAlong(route.points, *storey, grid.resolution);
  return route;
}

std::optional<Vector2d> freeCentre(const building::Room& of, const RoomToMove& room, const GridMap& grid) {
  double most = 0;
  for (const auto& corner : of.outline) most = std::max(most, (corner - of.centre).norm());
  const auto fits = [&](const Vector2i& cell) {
    return room.fits(cell) && building::contains(of, grid.middleOf(cell));
  };
  // Most centres are free themselves; the whole room is searched only if this one is not.
  for (const double within : {0.5, most}) {
    const auto reached =
        nearestCell(grid, of.centre, within, [&](const Vector2i& cell) { return room.isReached(cell) && fits(cell); });
    if (reached) return grid.middleOf(*reached);
  }
  const auto free = nearestCell(grid, of.centre, most, fits);
  if (!free) return std::nullopt;
  return grid.middleOf(*free);
}

}  // namespace omnimapper::query
