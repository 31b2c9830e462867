#include "FloorPlan.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace omnimapper::sim {

namespace {

constexpr double kDoorway = 0.6;        // [m] beyond its rooms the plan goes so far: thick walls have doors
constexpr double kOutsideFactor = 3.0;  // a way outside of the rooms costs so much more
constexpr double kTightFactor = 4.0;    // and one that only just fits
constexpr double kStep = 0.02;          // [m] of samples along a line
const double kHalfDiagonal = FloorPlan::kCell * std::sqrt(0.5);

template <class Visit>
void forEachEdge(const Polyline& polygon, const Visit& visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

template <class Visit>
void forEachSample(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double step, const Visit& visit) {
  const int count = 1 + static_cast<int>((to - from).norm() / step);
  for (int i = 0; i <= count; ++i) visit(Eigen::Vector2d(from + (to - from) * (static_cast<double>(i) / count)));
}

}  // namespace

bool isInside(const Polyline& polygon, const Eigen::Vector2d& point) {
  bool inside = false;
  forEachEdge(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if ((a.y() > point.y()) == (b.y() > point.y())) return;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  });
  return inside;
}

FloorPlan::FloorPlan(const World& world, double radius) : radius_(radius), needed_(radius + kHalfDiagonal + kStep / 2) {
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);
  low_ = -high;
  const auto take = [&](const Polyline& polygon) {
    for (const Eigen::Vector2d& corner : polygon) low_ = low_.cwiseMin(corner), high = high.cwiseMax(corner);
  };
  for (const Room& room : world.rooms) take(room.outline);
  if (world.rooms.empty()) std::for_each(world.obstacles.begin(), world.obstacles.end(), take);
  if (low_.x() > high.x()) low_ = high = Eigen::Vector2d::Zero();
  low_ -= Eigen::Vector2d::Constant(kDoorway);
  high += Eigen::Vector2d::Constant(kDoorway);
  columns_ = static_cast<int>(std::ceil((high.x() - low_.x()) / kCell));
  rows_ = static_cast<int>(std::ceil((high.y() - low_.y()) / kCell));
  markRooms(world);
  measureClearance(world);
  labelParts();
}

int FloorPlan::cellOf(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d cell = ((point - low_) / kCell).array().floor();
  if (!(cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns_ && cell.y() < rows_)) return -1;
  return static_cast<int>(cell.y()) * columns_ + static_cast<int>(cell.x());
}

Eigen::Vector2d FloorPlan::middleOf(int cell) const {
  return low_ + kCell * Eigen::Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5);
}

template <class Visit>
void FloorPlan::forEachCellNear(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double margin,
                                const Visit& visit) const {
  const auto bound = [&](double value, double origin, int count) {
    return static_cast<int>(std::clamp(std::floor((value - origin) / kCell), 0.0, count - 1.0));
  };
  const int first_column = bound(low.x() - margin, low_.x(), columns_),
            first_row = bound(low.y() - margin, low_.y(), rows_);
  const int last_column = bound(high.x() + margin, low_.x(), columns_),
            last_row = bound(high.y() + margin, low_.y(), rows_);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const int cell = row * columns_ + column;
      visit(cell, middleOf(cell));
    }
  }
}

void FloorPlan::markRooms(const World& world) {
  is_in_room_.assign(static_cast<std::size_t>(columns_) * rows_, world.rooms.empty());
  clearance_.assign(is_in_room_.size(), world.rooms.empty() ? static_cast<float>(radius_ + kComfort) : -1.0f);
  for (const Room& room : world.rooms) {
    Eigen::Vector2d low = room.outline.front(), high = low;
    for (const Eigen::Vector2d& corner : room.outline) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    forEachCellNear(low, high, 0, [&](int cell, const Eigen::Vector2d& middle) {
      if (!isInside(room.outline, middle)) return;
      is_in_room_[cell] = 1;
      clearance_[cell] = static_cast<float>(radius_ + kComfort);
    });
    forEachEdge(room.outline, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      forEachCellNear(a.cwiseMin(b), a.cwiseMax(b), kDoorway, [&](int cell, const Eigen::Vector2d& middle) {
        if (distanceToSegment(middle, a, b) <= kDoorway) clearance_[cell] = static_cast<float>(radius_ + kComfort);
      });
    });
  }
}

void FloorPlan::measureClearance(const World& world) {
  for (const Polyline& obstacle : world.obstacles) {
    if (obstacle.empty()) continue;
    Eigen::Vector2d low = obstacle.front(), high = low;
    for (const Eigen::Vector2d& corner : obstacle) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    forEachCellNear(low, high, 0, [&](int cell, const Eigen::Vector2d& middle) {
      if (clearance_[cell] > 0 && isInside(obstacle, middle)) clearance_[cell] = 0;
    });
    forEachEdge(obstacle, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      forEachCellNear(a.cwiseMin(b), a.cwiseMax(b), radius_ + kComfort, [&](int cell, const Eigen::Vector2d& middle) {
        if (clearance_[cell] > 0)
          clearance_[cell] = std::min(clearance_[cell], static_cast<float>(distanceToSegment(middle, a, b)));
      });
    });
  }
}

void FloorPlan::labelParts() {
  part_.assign(clearance_.size(), -1);
  std::vector<int> open;
  int parts = 0;
  std::size_t largest = 0;
  for (int seed = 0; seed < static_cast<int>(part_.size()); ++seed) {
    if (part_[seed] >= 0 || !isFreeCell(seed)) continue;
    std::size_t size = 0;
    part_[seed] = parts;
    open.assign(1, seed);
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      size += is_in_room_[cell] ? 1 : 0;
      const int column = cell % columns_, row = cell / columns_;
      const auto reach = [&](int neighbour) {
        if (part_[neighbour] >= 0 || !isFreeCell(neighbour)) return;
        part_[neighbour] = parts;
        open.push_back(neighbour);
      };
      if (column > 0) reach(cell - 1);
      if (column + 1 < columns_) reach(cell + 1);
      if (row > 0) reach(cell - columns_);
      if (row + 1 < rows_) reach(cell + columns_);
    }
    if (size > largest) largest = size, largest_part_ = parts;
    ++parts;
  }
}

bool FloorPlan::isFree(const Eigen::Vector2d& point) const {
  return isFreeCell(cellOf(point));
}

bool FloorPlan::isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  bool free = true;
  forEachSample(from, to, kStep, [&](const Eigen::Vector2d& point) { free = free && isFree(point); });
  return free;
}

bool FloorPlan::isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  bool seen = true;
  forEachSample(from, to, kCell,
                [&](const Eigen::Vector2d& point) { seen = seen && clearance(point) > kHalfDiagonal; });
  return seen;
}

double FloorPlan::clearance(const Eigen::Vector2d& point) const {
  const int cell = cellOf(point);
  return cell < 0 ? -1.0 : static_cast<double>(clearance_[cell]);
}

std::optional<Eigen::Vector2d> FloorPlan::nearestFree(const Eigen::Vector2d& point,
                                                      const std::optional<Eigen::Vector2d>& from) const {
  const int part = from && cellOf(*from) >= 0 ? part_[cellOf(*from)] : largest_part_;
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int cell = 0; cell < static_cast<int>(part_.size()); ++cell) {
    if (part_[cell] < 0 || part_[cell] != part) continue;
    const double distance = (middleOf(cell) - point).squaredNorm();
    if (distance < best_distance) best_distance = distance, best = cell;
  }
  if (best < 0) return std::nullopt;
  return middleOf(best);
}

bool FloorPlan::canReach(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  return isFree(from) && isFree(to) && part_[cellOf(from)] == part_[cellOf(to)];
}

bool FloorPlan::isInLargestPart(const Eigen::Vector2d& point) const {
  return isFree(point) && part_[cellOf(point)] == largest_part_;
}

double FloorPlan::costOf(int cell) const {
  const double tight = std::max(0.0, (radius_ + kComfort - static_cast<double>(clearance_[cell])) / kComfort);
  return (1 + kTightFactor * tight * tight) * (is_in_room_[cell] ? 1 : kOutsideFactor);
}

double FloorPlan::costOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  double sum = 0;
  int count = 0;
  forEachSample(from, to, kStep, [&](const Eigen::Vector2d& point) {
    const int cell = cellOf(point);
    sum += isFreeCell(cell) ? costOf(cell) : std::numeric_limits<double>::infinity();
    ++count;
  });
  return sum / count * (to - from).norm();
}

// Best first over the free cells; ends when `arrived(cell, cost)` says so. Ties go by the cell's number.
template <class Estimate, class Arrived>
void FloorPlan::grow(int from, const Estimate& estimate, const Arrived& arrived) const {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  auto& [cost, closed, came_from, touched] = scratch_;
  // Most searches see little of a large plan: only what the last one touched is made new.
  cost.resize(clearance_.size(), std::numeric_limits<float>::infinity());
  closed.resize(clearance_.size(), 0);
  came_from.resize(clearance_.size(), -1);
  for (const int cell : touched) {
    cost[cell] = std::numeric_limits<float>::infinity();
    closed[cell] = 0;
    came_from[cell] = -1;
  }
  touched.assign(1, from);
  cost[from] = 0;
  open.emplace(estimate(from), from);
  while (!open.empty()) {
    const int cell = open.top().second;
    open.pop();
    if (closed[cell]) continue;
    closed[cell] = 1;
    if (arrived(cell, static_cast<double>(cost[cell]))) return;
    const int column = cell % columns_, row = cell / columns_;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (column + dx < 0 || column + dx >= columns_ || row + dy < 0 || row + dy >= rows_) continue;
        const int next = cell + dy * columns_ + dx;
        if (closed[next] || !isFreeCell(next)) continue;
        const double step = kCell * std::hypot(dx, dy) * 0.5 * (costOf(cell) + costOf(next));
        const float total = cost[cell] + static_cast<float>(step);
        if (total >= cost[next]) continue;
        if (std::isinf(cost[next])) touched.push_back(next);
        cost[next] = total;
        came_from[next] = cell;
        open.emplace(static_cast<double>(total) + estimate(next), next);
      }
    }
  }
}

std::optional<Polyline> FloorPlan::findPath(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  if (!canReach(from, to)) return std::nullopt;
  const std::vector<int>& came_from = scratch_.came_from;
  const int goal = cellOf(to);
  const Eigen::Vector2d goal_middle = middleOf(goal);
  grow(
      cellOf(from), [&](int cell) { return (middleOf(cell) - goal_middle).norm(); },
      [&](int cell, double) { return cell == goal; });
  Polyline path{to};
  for (int cell = came_from[goal]; cell >= 0 && came_from[cell] >= 0; cell = came_from[cell])
    path.push_back(middleOf(cell));
  path.push_back(from);
  std::reverse(path.begin(), path.end());
  return shortened(path);
}

// Leaves out corners where the straight line costs no more than the way around.
Polyline FloorPlan::shortened(const Polyline& path) const {
  constexpr double kSlack = 1.02;
  std::vector<double> so_far{0};
  for (std::size_t i = 1; i < path.size(); ++i) so_far.push_back(so_far.back() + costOf(path[i - 1], path[i]));
  Polyline kept{path.front()};
  std::size_t at = 0;
  while (at + 1 < path.size()) {
    std::size_t next = at + 1;
    // Doubling, then halving: long straight ways need few tests.
    for (std::size_t stride = 1; stride > 0;) {
      const std::size_t candidate = std::min(next + stride, path.size() - 1);
      const bool fits =
          candidate > next && costOf(path[at], path[candidate]) <= kSlack * (so_far[candidate] - so_far[at]) + 1e-9;
      if (fits) next = candidate;
      stride = fits ? 2 * stride : stride / 2;
    }
    kept.push_back(path[next]);
    at = next;
  }
  return kept;
}

int FloorPlan::nearest(const Eigen::Vector2d& from, const std::vector<Target>& targets) const {
  std::vector<std::pair<int, int>> at_cell;
  for (std::size_t i = 0; i < targets.size(); ++i) at_cell.emplace_back(cellOf(targets[i].point), static_cast<int>(i));
  std::sort(at_cell.begin(), at_cell.end());
  int best = -1;
  double best_cost = std::numeric_limits<double>::infinity();
  grow(
      cellOf(from), [](int) { return 0.0; },
      [&](int cell, double cost) {
        auto target = std::lower_bound(at_cell.begin(), at_cell.end(), std::make_pair(cell, 0));
        for (; target != at_cell.end() && target->first == cell; ++target) {
          const double total = cost + targets[target->second].extra;
          if (total < best_cost) best_cost = total, best = target->second;
        }
        return cost >= best_cost;
      });
  return best;
}

}  // namespace omnimapper::sim
