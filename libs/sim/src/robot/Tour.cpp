#include "Tour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

namespace omnimapper::sim {

namespace {

constexpr double kViewSpacing = 0.5;   // [m] smallest distance between places to look from
constexpr double kSeenSpacing = 0.25;  // [m] smallest distance between points that are to be seen
constexpr double kLeaveRoom = 8.0;     // [m] added to the cost of a path into another room
constexpr double kEnoughSeen = 0.98;   // part of the visible points that is to be seen

// A lattice of points inside a room, row by row.
class Lattice {
 public:
  Lattice(const Room& room, double spacing) {
    const auto [low, high] = boundsOf(room.outline);
    const Eigen::Array2d size = (high - low).array();
    const int columns = std::max(1, static_cast<int>(size.x() / spacing)),
              rows = std::max(1, static_cast<int>(size.y() / spacing));
    low_y_ = low.y();
    step_y_ = size.y() / rows;
    for (int row = 0; row < rows; ++row) {
      begin_of_row_.push_back(points_.size());
      for (int column = 0; column < columns; ++column) {
        const Eigen::Vector2d point =
            low + Eigen::Vector2d(size.x() * (column + 0.5) / columns, size.y() * (row + 0.5) / rows);
        if (contains(room.outline, point)) points_.push_back(point);
      }
    }
    begin_of_row_.push_back(points_.size());
  }

  const std::vector<Eigen::Vector2d>& points() const { return points_; }

  /// Calls `visit` with the indices of the points within a distance of `middle`, in order.
  template <class Visit>
  void forEachNear(const Eigen::Vector2d& middle, double distance, const Visit& visit) const {
    const int rows = static_cast<int>(begin_of_row_.size()) - 1;
    const auto rowAt = [&](double y) { return static_cast<int>(std::floor((y - low_y_) / step_y_)); };
    const int first = std::max(0, rowAt(middle.y() - distance)),
              last = std::min(rows - 1, rowAt(middle.y() + distance));
    for (int row = first; row <= last; ++row) {
      const auto begin = points_.begin() + begin_of_row_[row], end = points_.begin() + begin_of_row_[row + 1];
      const auto isLeftOf = [](const Eigen::Vector2d& point, double x) { return point.x() < x; };
      for (auto point = std::lower_bound(begin, end, middle.x() - distance, isLeftOf);
           point != end && point->x() <= middle.x() + distance; ++point) {
        if ((*point - middle).norm() <= distance) visit(static_cast<int>(point - points_.begin()));
      }
    }
  }

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::ptrdiff_t> begin_of_row_;  // and, as the last, the end of the last row
  double low_y_ = 0, step_y_ = 1;
};

// Greedy cover: repeatedly takes the place that sees most of what has not been seen yet.
std::vector<Eigen::Vector2d> placesToSee(const Room& room, const RobotSpace& plan, const Eigen::Vector2d& start,
                                         double reach) {
  const Lattice to_see(room, std::max(kSeenSpacing, reach / 12));
  std::vector<Eigen::Vector2d> places = Lattice(room, std::max(kViewSpacing, reach / 6)).points();
  if (const auto good = goodPlaceIn(room, plan)) places.push_back(*good);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const Eigen::Vector2d& place) { return !plan.canReach(start, place); }),
               places.end());
  std::vector<std::vector<int>> sees(places.size());
  std::vector<char> open(to_see.points().size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    to_see.forEachNear(places[i], reach, [&](int j) {
      if (!plan.isSeen(places[i], to_see.points()[j])) return;
      sees[i].push_back(j);
      open[j] = 1;
    });
  }
  const auto gainOf = [&](int i) {
    double gain = 0;
    for (const int j : sees[i]) gain += open[j];
    // Of two places that see equally much, the roomier one is better.
    return gain + 0.5 * plan.clearance(places[i]);
  };
  // The gain of a place can only shrink, so it is computed again only when it seems to be the largest.
  using Candidate = std::pair<double, int>;  // gain, and minus the number, so that of equal gains the first is taken
  std::priority_queue<Candidate> candidates;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) candidates.emplace(gainOf(i), -i);
  const auto visible = static_cast<double>(std::count(open.begin(), open.end(), 1));
  std::vector<Eigen::Vector2d> chosen;
  for (double seen = 0; seen < kEnoughSeen * visible;) {
    const auto [gain, minus_number] = candidates.top();
    candidates.pop();
    const int best = -minus_number;
    if (const double now = gainOf(best); now < gain) {
      candidates.emplace(now, minus_number);
      continue;
    }
    for (const int j : sees[best]) seen += open[j], open[j] = 0;
    chosen.push_back(places[best]);
  }
  return chosen;
}

}  // namespace

std::optional<Eigen::Vector2d> goodPlaceIn(const Room& room, const RobotSpace& plan) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : room.outline) middle += corner / static_cast<double>(room.outline.size());
  std::optional<Eigen::Vector2d> best;
  double best_worth = 0;
  const Lattice lattice(room, 0.1);
  for (const Eigen::Vector2d& point : lattice.points()) {
    if (!plan.isFree(point)) continue;
    const double part = plan.isInLargestPart(point) ? 0 : -1e6;
    const double worth = part + 10 * plan.clearance(point) - (point - middle).norm();
    if (!best || worth > best_worth) best = point, best_worth = worth;
  }
  return best;
}

std::vector<Stop> planTour(const World& world, const std::vector<int>& rooms, const RobotSpace& plan,
                           const std::optional<Eigen::Vector2d>& start, double reach) {
  std::optional<Eigen::Vector2d> at = start;
  for (const int room : rooms) {
    if (at) break;
    const auto place = goodPlaceIn(world.rooms[room], plan);
    if (place && plan.isInLargestPart(*place)) at = place;
  }
  if (!at) return {};
  std::vector<RobotSpace::Target> left;
  std::vector<int> room_of;
  for (const int room : rooms) {
    for (const Eigen::Vector2d& place : placesToSee(world.rooms[room], plan, *at, reach)) {
      left.push_back({place, 0});
      room_of.push_back(room);
    }
  }
  std::vector<Stop> stops;
  int room_now = -1;
  while (!left.empty()) {
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i].extra = room_now >= 0 && room_of[i] != room_now ? kLeaveRoom : 0;
    const int next = plan.nearest(*at, left);
    if (next < 0) break;
    at = left[next].point;
    room_now = room_of[next];
    stops.push_back({*at, {}, world.rooms[room_now].name});
    left.erase(left.begin() + next);
    room_of.erase(room_of.begin() + next);
  }
  return stops;
}

}  // namespace omnimapper::sim
