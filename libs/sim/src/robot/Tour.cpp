#include "Tour.h"

#include <algorithm>

namespace omnimapper::sim {

namespace {

constexpr double kViewSpacing = 0.5;   // [m] of places to look from, at least
constexpr double kSeenSpacing = 0.25;  // [m] of places that are to be seen, at least
constexpr double kLeaveRoom = 8.0;     // [m] a way into another room counts as so much longer
constexpr double kEnough = 0.98;       // part of a room that is to be seen

// A lattice over the room's inside.
std::vector<Eigen::Vector2d> latticeIn(const Room& room, double spacing) {
  const auto [low, high] = boundsOf(room.outline);
  const Eigen::Array2d size = (high - low).array();
  const int columns = std::max(1, static_cast<int>(size.x() / spacing)),
            rows = std::max(1, static_cast<int>(size.y() / spacing));
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d point =
          low + Eigen::Vector2d(size.x() * (column + 0.5) / columns, size.y() * (row + 0.5) / rows);
      if (contains(room.outline, point)) points.push_back(point);
    }
  }
  return points;
}

// Greedy cover: again and again the place that sees most of what has not been seen.
std::vector<Eigen::Vector2d> placesToSee(const Room& room, const FloorPlan& plan, const Eigen::Vector2d& start,
                                         double reach) {
  const std::vector<Eigen::Vector2d> seen_from = latticeIn(room, std::max(kSeenSpacing, reach / 12));
  std::vector<Eigen::Vector2d> places = latticeIn(room, std::max(kViewSpacing, reach / 6));
  if (const auto good = goodPlaceIn(room, plan)) places.push_back(*good);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const Eigen::Vector2d& place) { return !plan.canReach(start, place); }),
               places.end());
  std::vector<std::vector<int>> sees(places.size());
  std::vector<char> open(seen_from.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < seen_from.size(); ++j) {
      if ((seen_from[j] - places[i]).norm() > reach || !plan.isSeen(places[i], seen_from[j])) continue;
      sees[i].push_back(static_cast<int>(j));
      open[j] = 1;
    }
  }
  const auto visible = static_cast<double>(std::count(open.begin(), open.end(), 1));
  std::vector<Eigen::Vector2d> chosen;
  for (double seen = 0; seen < kEnough * visible;) {
    std::size_t best = 0;
    double best_gain = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      double gain = 0;
      for (const int j : sees[i]) gain += open[j];
      // Of two that see as much, the roomier one.
      gain += 0.5 * plan.clearance(places[i]);
      if (gain > best_gain) best_gain = gain, best = i;
    }
    for (const int j : sees[best]) seen += open[j], open[j] = 0;
    chosen.push_back(places[best]);
    places[best] = Eigen::Vector2d::Constant(1e9), sees[best].clear();
  }
  return chosen;
}

}  // namespace

std::optional<Eigen::Vector2d> goodPlaceIn(const Room& room, const FloorPlan& plan) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : room.outline) middle += corner / static_cast<double>(room.outline.size());
  std::optional<Eigen::Vector2d> best;
  double best_worth = 0;
  for (const Eigen::Vector2d& point : latticeIn(room, 0.1)) {
    if (!plan.isFree(point)) continue;
    const double part = plan.isInLargestPart(point) ? 0 : -1e6;
    const double worth = part + 10 * plan.clearance(point) - (point - middle).norm();
    if (!best || worth > best_worth) best = point, best_worth = worth;
  }
  return best;
}

std::vector<Stop> planTour(const World& world, const std::vector<int>& rooms, const FloorPlan& plan,
                           const std::optional<Eigen::Vector2d>& start, double reach) {
  std::optional<Eigen::Vector2d> at = start;
  for (const int room : rooms) {
    if (at) break;
    const auto place = goodPlaceIn(world.rooms[room], plan);
    if (place && plan.isInLargestPart(*place)) at = place;
  }
  if (!at) return {};
  std::vector<FloorPlan::Target> left;
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
