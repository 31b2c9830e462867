#include "RoomPaths.h"

#include <algorithm>
#include <array>
#include <deque>

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

constexpr double kRobotRadius = 0.33;   // a path through a room is this wide to both sides [m]
constexpr double kCell = 0.1;           // of the grid [m]
constexpr double kEnoughReached = 0.9;  // part of the free floor that must be reached

double distanceOf(const Vector2d& p, const Ring& ring) {
  if (contains(ring, p)) return 0;
  double distance = 1e9;
  for (std::size_t i = 0; i < ring.size(); ++i)
    distance = std::min(distance, distanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
  return distance;
}

}  // namespace

RoomPaths::RoomPaths(const Room& room, const std::vector<Ring>& doorways) {
  const Bounds bounds = boundsOf(room.outline);
  const Vector2d size = bounds.high - bounds.low;
  low_ = bounds.low;
  columns_ = static_cast<int>(size.x() / kCell) + 1;
  rows_ = static_cast<int>(size.y() / kCell) + 1;
  cells_.assign(static_cast<std::size_t>(columns_) * rows_, wall);
  mark(room.outline, 0, wall, inside);
  for (std::size_t i = 0; i < room.outline.size(); ++i)
    mark({room.outline[i], room.outline[(i + 1) % room.outline.size()]}, kRobotRadius, inside, wall);
  for (const Ring& ring : doorways) {
    mark(ring, 0, wall, door);
    mark(ring, 0, inside, door);
  }
}

void RoomPaths::block(const Ring& ring) {
  mark(ring, kRobotRadius, inside, wall);
  mark(ring, kRobotRadius, door, wall);
}

Vector2d RoomPaths::middleOf(int cell) const {
  return low_ + kCell * Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5);
}

// Changes cells within a distance of a ring from `from` to `to`.
void RoomPaths::mark(const Ring& ring, double distance, Cell from, Cell to) {
  const Bounds near = boundsOf(ring);
  const auto cellAt = [&](double value, int count) { return std::clamp(static_cast<int>(value / kCell), 0, count); };
  const int last_x = cellAt(near.high.x() + distance - low_.x() + kCell, columns_),
            last_y = cellAt(near.high.y() + distance - low_.y() + kCell, rows_);
  for (int y = cellAt(near.low.y() - distance - low_.y(), rows_); y < last_y; ++y) {
    for (int x = cellAt(near.low.x() - distance - low_.x(), columns_); x < last_x; ++x) {
      const int cell = y * columns_ + x;
      if (cells_[cell] == from && distanceOf(middleOf(cell), ring) <= distance) cells_[cell] = to;
    }
  }
}

std::size_t RoomPaths::markReached(int start, std::vector<Cell>& cells) const {
  std::deque<int> open{start};
  std::size_t reached = 0;
  cells[start] = visited;
  while (!open.empty()) {
    const int cell = open.front(), column = cell % columns_;
    open.pop_front();
    ++reached;
    const std::array<int, 4> next{column > 0 ? cell - 1 : -1, column + 1 < columns_ ? cell + 1 : -1, cell - columns_,
                                  cell + columns_};
    for (const int n : next) {
      if (n < 0 || n >= columns_ * rows_ || cells[n] == wall || cells[n] == visited) continue;
      cells[n] = visited;
      open.push_back(n);
    }
  }
  return reached;
}

bool RoomPaths::areOpen() const {
  const auto free_count = std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell != wall; });
  if (free_count == 0) return false;
  auto first = std::find(cells_.begin(), cells_.end(), door);
  if (first == cells_.end()) first = std::find(cells_.begin(), cells_.end(), inside);
  std::vector<Cell> cells = cells_;
  const std::size_t reached = markReached(static_cast<int>(first - cells_.begin()), cells);
  const bool all_doors = std::find(cells.begin(), cells.end(), door) == cells.end();
  return all_doors && static_cast<double>(reached) >= kEnoughReached * static_cast<double>(free_count);
}

}  // namespace omnimapper::sim
