#include "CompanionSearch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "CompanionWish.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

constexpr double kOffsetCell = 0.1;  // [m]
constexpr int kReach = 2;            // largest change of the offset in a step [cells]
constexpr double kSlack = 0.06;      // the search keeps farther away from the robot than smoothing does [m]
constexpr double kNearRobot = 0.15;  // companions do not like to be this near to the least distance [m]
constexpr double kNearOthers = 0.6;  // companions do not like to be nearer to other people [m]
constexpr double kTouching = 0.4;    // where they are as near as that, they touch other people [m]
constexpr double kRobotCost = 4, kOthersCost = 40;  // cost per second and metre that is missing
constexpr double kTouchCost = 200;                  // cost per second
constexpr int kSmoothings = 60;
constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::uint8_t kNoMove = 255;

struct OffsetMove {
  int right, up;  // change of the offset [cells]
};

std::vector<OffsetMove> allMoves() {
  std::vector<OffsetMove> moves{{0, 0}};
  for (int up = -kReach; up <= kReach; ++up) {
    for (int right = -kReach; right <= kReach; ++right) {
      const int square = right * right + up * up;
      if (square > 0 && square <= kReach * kReach) moves.push_back({right, up});
    }
  }
  return moves;
}

class WalkSearch {
 public:
  WalkSearch(const Polyline& wished, const CompanionObstacles& obstacles, double window)
      : wished_(wished),
        obstacles_(obstacles),
        half_(static_cast<int>(std::lround(window / kOffsetCell))),
        side_(2 * half_ + 1),
        moves_(allMoves()) {}

  Polyline walk() {
    const int states = side_ * side_;
    std::vector<float> before(states), now(states);
    for (int state = 0; state < states; ++state) before[state] = startCost(state);
    std::vector<std::vector<std::uint8_t>> came_by(wished_.size());
    for (std::size_t k = 1; k < wished_.size(); ++k) {
      came_by[k].assign(states, kNoMove);
      step(k, before, now, came_by[k]);
      before.swap(now);
    }
    const auto best = std::min_element(before.begin(), before.end());
    if (*best == kNever) return {};
    int state = static_cast<int>(best - before.begin());
    Polyline places(wished_.size());
    for (std::size_t k = wished_.size(); k-- > 0;) {
      places[k] = placeOf(k, state);
      if (k == 0) break;
      const OffsetMove& move = moves_[came_by[k][state]];
      state -= move.up * side_ + move.right;
    }
    return places;
  }

 private:
  Vector2d offsetOf(int state) const { return kOffsetCell * Vector2d(state % side_ - half_, state / side_ - half_); }
  Vector2d placeOf(std::size_t k, int state) const { return wished_[k] + offsetOf(state); }

  // Cost of being somewhere during a step; kNever where a person cannot be.
  float costOf(std::size_t k, const Vector2d& place) const {
    const double from_robot = (place - obstacles_.robot[k]).norm();
    if (from_robot < obstacles_.robot_distance + kSlack || !obstacles_.space.isFree(place)) return kNever;
    double cost = (place - wished_[k]).squaredNorm();
    cost += kRobotCost * std::max(0.0, obstacles_.robot_distance + kNearRobot - from_robot);
    for (const Polyline& other : obstacles_.others) {
      const double distance = distanceToSegment(place, other[k > 0 ? k - 1 : 0], other[k]);
      if (distance < obstacles_.others_distance) return kNever;
      if (distance < kNearOthers) cost += kOthersCost * (kNearOthers - distance);
      if (distance < kTouching) cost += kTouchCost;
    }
    return static_cast<float>(cost * kCompanionStep);
  }

  // A walk begins where the robot is in sight, not behind a wall.
  float startCost(int state) const {
    const Vector2d place = placeOf(0, state);
    const float cost = costOf(0, place);
    return cost < kNever && obstacles_.space.isSeen(obstacles_.robot[0], place) ? cost : kNever;
  }

  void step(std::size_t k, const std::vector<float>& before, std::vector<float>& now,
            std::vector<std::uint8_t>& came_by) const {
    const Vector2d wish_moves = wished_[k] - wished_[k - 1];
    std::vector<float> move_costs;
    for (const OffsetMove& move : moves_) {
      const Vector2d change = kOffsetCell * Vector2d(move.right, move.up);
      const bool is_slow = (wish_moves + change).norm() <= kFastestCompanion * kCompanionStep;
      move_costs.push_back(is_slow ? static_cast<float>(change.squaredNorm() / kCompanionStep) : kNever);
    }
    for (int state = 0; state < side_ * side_; ++state) {
      now[state] = kNever;
      const float cost = costOf(k, placeOf(k, state));
      if (cost == kNever) continue;
      const int column = state % side_, row = state / side_;
      float least = kNever;
      for (std::size_t i = 0; i < moves_.size(); ++i) {
        const int from_column = column - moves_[i].right, from_row = row - moves_[i].up;
        if (from_column < 0 || from_column >= side_ || from_row < 0 || from_row >= side_) continue;
        const float total = before[from_row * side_ + from_column] + move_costs[i];
        if (total >= least) continue;
        least = total;
        came_by[state] = static_cast<std::uint8_t>(i);
      }
      now[state] = least + cost;
    }
  }

  const Polyline& wished_;
  const CompanionObstacles& obstacles_;
  const int half_, side_;
  const std::vector<OffsetMove> moves_;
};

// Means of neighbouring offsets replace the offsets wherever the place that results is allowed.
void smoothWalk(const Polyline& wished, const CompanionObstacles& obstacles, Polyline& places) {
  constexpr double kLongest = kFastestCompanion * kCompanionStep;
  const auto isAllowed = [&](std::size_t k, const Vector2d& place) {
    return (place - places[k - 1]).norm() <= kLongest && (place - places[k + 1]).norm() <= kLongest &&
           (place - obstacles.robot[k]).norm() >= obstacles.robot_distance && obstacles.space.isFree(place) &&
           std::all_of(obstacles.others.begin(), obstacles.others.end(), [&](const Polyline& other) {
             const double distance = (place - other[k]).norm();
             return distance >= kTouching || distance >= (places[k] - other[k]).norm();
           });
  };
  for (int pass = 0; pass < kSmoothings; ++pass) {
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
      const Vector2d before = places[k - 1] - wished[k - 1], now = places[k] - wished[k],
                     after = places[k + 1] - wished[k + 1];
      const Vector2d mean = (before + 2 * now + after) / 4;
      if (mean == now) continue;
      const Vector2d place = wished[k] + mean;
      if (isAllowed(k, place)) places[k] = place;
    }
  }
}

}  // namespace

Polyline walkNear(const Polyline& wished, const CompanionObstacles& obstacles, double window) {
  Polyline places = WalkSearch(wished, obstacles, window).walk();
  if (!places.empty()) smoothWalk(wished, obstacles, places);
  return places;
}

}  // namespace omnimapper::sim
