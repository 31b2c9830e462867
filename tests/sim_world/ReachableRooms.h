#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/World.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace reachable_rooms {

using namespace omnimapper;
using Eigen::Vector2d;

/// Names of the rooms that a disc of 0.3 m radius cannot reach from the first room, on a grid of 0.1 m; grounds
/// outdoors do not count.
inline std::vector<std::string> unreachableRooms(const sim::World& world) {
  constexpr double kCell = 0.1, kRadius = 0.3;
  Vector2d low = world.rooms[0].outline[0], high = low;
  for (const auto& room : world.rooms) {
    for (const Vector2d& p : room.outline) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const int columns = static_cast<int>((high - low).x() / kCell) + 1,
            rows = static_cast<int>((high - low).y() / kCell) + 1;
  std::vector<int> state(static_cast<std::size_t>(columns) * rows, 1);
  const auto middle = [&](int cell) -> Vector2d {
    return low + kCell * Vector2d(cell % columns + 0.5, cell / columns + 0.5);
  };
  for (const auto& ring : world.obstacles) {
    Vector2d from = ring[0], to = from;
    for (const Vector2d& p : ring) {
      from = from.cwiseMin(p);
      to = to.cwiseMax(p);
    }
    const auto bound = [&](double value, int count) {
      return std::clamp(static_cast<int>(std::floor(value / kCell)), 0, count);
    };
    for (int y = bound(from.y() - kRadius - low.y(), rows); y < bound(to.y() + kRadius - low.y() + kCell, rows); ++y) {
      for (int x = bound(from.x() - kRadius - low.x(), columns); x < bound(to.x() + kRadius - low.x() + kCell, columns);
           ++x) {
        const Vector2d p = middle(y * columns + x);
        double distance = sim::contains(ring, p) ? 0 : 1e9;
        for (std::size_t i = 0; i < ring.size() && distance > 0; ++i)
          distance = std::min(distance, sim::distanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
        if (distance < kRadius) state[y * columns + x] = 0;
      }
    }
  }
  std::vector<int> open;
  std::vector<int> room_of(state.size(), -1);
  for (int cell = 0; cell < columns * rows; ++cell) {
    for (std::size_t r = 0; r < world.rooms.size() && room_of[cell] < 0; ++r) {
      if (sim::contains(world.rooms[r].outline, middle(cell))) room_of[cell] = static_cast<int>(r);
    }
  }
  // The search starts in the largest free part of the first room.
  std::vector<char> reached(world.rooms.size(), 0);
  std::size_t best = 0;
  for (int seed = 0; seed < columns * rows; ++seed) {
    if (state[seed] != 1 || room_of[seed] != 0) continue;
    open.assign(1, seed);
    state[seed] = 2;
    std::vector<char> seen(world.rooms.size(), 0);
    std::size_t size = 0;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      ++size;
      if (room_of[cell] >= 0) seen[room_of[cell]] = 1;
      for (const int next : {cell % columns > 0 ? cell - 1 : -1, cell % columns + 1 < columns ? cell + 1 : -1,
                             cell - columns, cell + columns}) {
        if (next < 0 || next >= columns * rows || state[next] != 1) continue;
        state[next] = 2;
        open.push_back(next);
      }
    }
    if (size > best) {
      best = size;
      reached = seen;
    }
  }
  std::vector<std::string> missing;
  for (std::size_t r = 0; r < world.rooms.size(); ++r) {
    if (!reached[r] && !world.rooms[r].is_outdoors) missing.push_back(world.rooms[r].name);
  }
  return missing;
}

}  // namespace reachable_rooms
