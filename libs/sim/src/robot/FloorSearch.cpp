// Lines and paths in a RobotSpace.
#include <algorithm>
#include <cmath>
#include <queue>

#include "RobotSpace.h"

namespace omnimapper::sim {

namespace {

constexpr double kOutsideFactor = 3.0;  // factor on the cost of a path outside the rooms
constexpr double kTightFactor = 4.0;    // relative extra cost of a path that only just fits

template <class Visit>
void forEachSample(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double step, const Visit& visit) {
  const int count = 1 + static_cast<int>((to - from).norm() / step);
  for (int i = 0; i <= count; ++i) visit(Eigen::Vector2d(from + (to - from) * (static_cast<double>(i) / count)));
}

}  // namespace

bool RobotSpace::isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  bool free = true;
  forEachSample(from, to, kStep, [&](const Eigen::Vector2d& point) { free = free && isFree(point); });
  return free;
}

bool RobotSpace::isSeen(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  bool seen = true;
  forEachSample(from, to, kCell,
                [&](const Eigen::Vector2d& point) { seen = seen && clearance(point) > kHalfDiagonal; });
  return seen;
}

double RobotSpace::costOf(int cell) const {
  const double tight = std::max(0.0, (radius_ + kComfort - static_cast<double>(clearance_[cell])) / kComfort);
  return (1 + kTightFactor * tight * tight) * (is_in_room_[cell] ? 1 : kOutsideFactor);
}

double RobotSpace::costOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  double sum = 0;
  int count = 0;
  forEachSample(from, to, kStep, [&](const Eigen::Vector2d& point) {
    const int cell = cellOf(point);
    sum += isFreeCell(cell) ? costOf(cell) : std::numeric_limits<double>::infinity();
    ++count;
  });
  return sum / count * (to - from).norm();
}

// Best-first search over the free cells; it ends when `arrived(cell, cost)` returns true. The cell's number breaks
// ties.
template <class Estimate, class Arrived>
void RobotSpace::grow(int from, const Estimate& estimate, const Arrived& arrived) const {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  auto& [cost, closed, came_from, touched] = scratch_;
  // Most searches visit a small part of a large plan, so only the cells that the last one touched are reset.
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

std::optional<Polyline> RobotSpace::findPath(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
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

// Leaves out corners where the straight line costs no more than the path around.
Polyline RobotSpace::shortened(const Polyline& path) const {
  constexpr double kSlack = 1.02;
  std::vector<double> so_far{0};
  for (std::size_t i = 1; i < path.size(); ++i) so_far.push_back(so_far.back() + costOf(path[i - 1], path[i]));
  Polyline kept{path.front()};
  std::size_t at = 0;
  while (at + 1 < path.size()) {
    std::size_t next = at + 1;
    // The stride is doubled, then halved, so that long straight paths need few tests.
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

int RobotSpace::nearest(const Eigen::Vector2d& from, const std::vector<Target>& targets) const {
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
