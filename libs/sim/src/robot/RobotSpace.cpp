#include "RobotSpace.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

constexpr double kDoorway = 0.6;  // [m] distance that the plan extends beyond the rooms, because thick walls have doors

template <class Visit>
void forEachEdge(const Polyline& polygon, const Visit& visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

}  // namespace

RobotSpace::RobotSpace(const World& world, double radius)
    : radius_(radius), needed_(radius + kHalfDiagonal + kStep / 2) {
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

int RobotSpace::cellOf(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d cell = ((point - low_) / kCell).array().floor();
  if (!(cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns_ && cell.y() < rows_)) return -1;
  return static_cast<int>(cell.y()) * columns_ + static_cast<int>(cell.x());
}

Eigen::Vector2d RobotSpace::middleOf(int cell) const {
  return low_ + kCell * Eigen::Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5);
}

template <class Visit>
void RobotSpace::forEachCellNear(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double margin,
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

void RobotSpace::markRooms(const World& world) {
  is_in_room_.assign(static_cast<std::size_t>(columns_) * rows_, world.rooms.empty());
  clearance_.assign(is_in_room_.size(), world.rooms.empty() ? static_cast<float>(radius_ + kComfort) : -1.0f);
  for (const Room& room : world.rooms) {
    const auto [low, high] = boundsOf(room.outline);
    forEachCellNear(low, high, 0, [&](int cell, const Eigen::Vector2d& middle) {
      if (!contains(room.outline, middle)) return;
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

void RobotSpace::measureClearance(const World& world) {
  for (const Polyline& obstacle : world.obstacles) {
    if (obstacle.empty()) continue;
    const auto [low, high] = boundsOf(obstacle);
    forEachCellNear(low, high, 0, [&](int cell, const Eigen::Vector2d& middle) {
      if (clearance_[cell] > 0 && contains(obstacle, middle)) clearance_[cell] = 0;
    });
    forEachEdge(obstacle, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      forEachCellNear(a.cwiseMin(b), a.cwiseMax(b), radius_ + kComfort, [&](int cell, const Eigen::Vector2d& middle) {
        if (clearance_[cell] > 0)
          clearance_[cell] = std::min(clearance_[cell], static_cast<float>(distanceToSegment(middle, a, b)));
      });
    });
  }
}

void RobotSpace::labelParts() {
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

bool RobotSpace::isFree(const Eigen::Vector2d& point) const {
  return isFreeCell(cellOf(point));
}

double RobotSpace::clearance(const Eigen::Vector2d& point) const {
  const int cell = cellOf(point);
  return cell < 0 ? -1.0 : static_cast<double>(clearance_[cell]);
}

std::optional<Eigen::Vector2d> RobotSpace::nearestFree(const Eigen::Vector2d& point,
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

bool RobotSpace::canReach(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  return isFree(from) && isFree(to) && part_[cellOf(from)] == part_[cellOf(to)];
}

bool RobotSpace::isInLargestPart(const Eigen::Vector2d& point) const {
  return isFree(point) && part_[cellOf(point)] == largest_part_;
}

}  // namespace omnimapper::sim
