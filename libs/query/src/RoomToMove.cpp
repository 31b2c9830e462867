#include <omnimapper/query/Goal.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::query {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;

constexpr int kMostCellsOfRadius = 10000;

// For each cell the distance along its row to the nearest cell that is not free, 0 for those themselves; outside the
// grid nothing is free.
std::vector<std::uint16_t> cellsToBlocked(const GridMap& grid) {
  constexpr int kFarthest = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint16_t> result(grid.cells.size());
  for (int row = 0; row < grid.rows; ++row) {
    const std::size_t begin = grid.indexOf({0, row});
    const auto columns = static_cast<std::size_t>(grid.columns);
    int run = 0;
    for (std::size_t i = begin; i < begin + columns; ++i) {
      run = grid.cells[i] == GridCell::free ? std::min(run + 1, kFarthest) : 0;
      result[i] = static_cast<std::uint16_t>(run);
    }
    run = 0;
    for (std::size_t i = begin + columns; i-- > begin;) {
      run = grid.cells[i] == GridCell::free ? std::min(run + 1, kFarthest) : 0;
      result[i] = static_cast<std::uint16_t>(std::min<int>(run, result[i]));
    }
  }
  return result;
}

// Half widths of a disc in the rows from its centre up. It is half a cell larger than the robot, because cells that are
// not free are blocked up to their edges.
std::vector<int> discOf(double radius_in_cells) {
  const double radius = std::min<double>(radius_in_cells + 0.5, kMostCellsOfRadius);
  std::vector<int> half_widths;
  for (int row = 0; row <= radius; ++row)
    half_widths.push_back(static_cast<int>(std::sqrt(radius * radius - static_cast<double>(row) * row)));
  return half_widths;
}

}  // namespace

RoomToMove::RoomToMove(const GridMap& grid, double radius, const Vector2d& start)
    : grid_(grid),
      to_blocked_(cellsToBlocked(grid)),
      half_widths_(discOf(radius / grid.resolution)),
      reached_(grid.cells.size()) {
  constexpr double kNearStart = 0.5;  // [m]
  const Vector2i middle = grid.cellOf(start);
  const int reach_of_search = static_cast<int>(std::ceil(kNearStart / grid.resolution));
  double least = kNearStart;
  std::optional<Vector2i> first;
  for (int dy = -reach_of_search; dy <= reach_of_search; ++dy) {
    for (int dx = -reach_of_search; dx <= reach_of_search; ++dx) {
      const Vector2i cell = middle + Vector2i(dx, dy);
      const double distance = dx == 0 && dy == 0 ? 0 : (grid.middleOf(cell) - start).norm();
      if (!fits(cell) || distance > least || (first && distance == least)) continue;
      least = distance;
      first = cell;
    }
  }
  if (first) reach(*first);
}

bool RoomToMove::fits(const Vector2i& cell) const {
  const auto rows = static_cast<int>(half_widths_.size());
  for (int dy = 1 - rows; dy < rows; ++dy) {
    const Vector2i in_row = cell + Vector2i(0, dy);
    if (!grid_.contains(in_row)) return false;
    if (to_blocked_[grid_.indexOf(in_row)] <= half_widths_[static_cast<std::size_t>(std::abs(dy))]) return false;
  }
  return true;
}

void RoomToMove::reach(const Vector2i& first) {
  start_ = first;
  std::vector<Vector2i> open{first};
  reached_[grid_.indexOf(first)] = true;
  while (!open.empty()) {
    const Vector2i cell = open.back();
    open.pop_back();
    for (const Vector2i& step : {Vector2i(1, 0), Vector2i(-1, 0), Vector2i(0, 1), Vector2i(0, -1)}) {
      const Vector2i next = cell + step;
      if (!grid_.contains(next) || reached_[grid_.indexOf(next)] || !fits(next)) continue;
      reached_[grid_.indexOf(next)] = true;
      open.push_back(next);
    }
  }
}

bool RoomToMove::isReached(const Vector2i& cell) const {
  return grid_.contains(cell) && reached_[grid_.indexOf(cell)];
}

bool RoomToMove::isSeen(const Vector2d& from, const Vector2d& to, double tolerance) const {
  const double length = (to - from).norm() - tolerance, step = grid_.resolution / 2;
  const Vector2d along = (to - from).normalized();
  for (double at = 0; at < length; at += step)
    if (grid_.at(grid_.cellOf(from + at * along)) == GridCell::occupied) return false;
  return true;
}

}  // namespace omnimapper::query
