#include <omnimapper/query/Distance.h>
#include <omnimapper/query/Goal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace omnimapper::query {

namespace {

using Eigen::Vector2d;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// A possible pose and its cost.
struct Candidate {
  Vector2d at, edge;
  double cost = 0;
};

Vector2d turned(const Vector2d& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

// The horizontal part of a direction as a unit vector; none if the direction is steep.
std::optional<Vector2d> levelPart(const std::optional<Eigen::Vector3d>& direction) {
  constexpr double kLevel = 0.5;
  if (!direction || direction->head<2>().norm() < kLevel) return std::nullopt;
  return direction->head<2>().normalized();
}

/// The side from which a target is approached.
struct Side {
  Vector2d direction;  // unit, from the target
  double most_turn;    // [rad] largest deviation of the pose from this direction
};

// The free side of a target. A target that is only a point, such as a sign without a normal, is approached from where
// it was seen.
Side sideOf(const map::Place& target, const Vector2d& edge, const Vector2d& start) {
  constexpr double kOffFreeSide = 60 * kDegree, kAllAround = 180 * kDegree;
  if (const auto normal = levelPart(target.normal)) return {*normal, kOffFreeSide};
  const bool is_point = target.extent.lines.empty() && target.extent.outlines.empty();
  const auto seen_from = levelPart(target.seen_from);
  if (is_point && seen_from) return {*seen_from, kOffFreeSide};
  const Vector2d to_start = start - edge;
  return {to_start.norm() > 0 ? Vector2d(to_start.normalized()) : Vector2d(1, 0), kAllAround};
}

std::vector<Candidate> candidatesBefore(const map::Place& target, const Vector2d& start, double wanted) {
  constexpr double kRimStep = 0.25, kTurnStep = 15 * kDegree;
  constexpr double kOfDistance = 2, kOfTurn = 0.5;  // cost [m along the rim] of 1 m of distance and of 1 rad of turn
  constexpr std::array<double, 9> kFactors{1, 0.9, 1.1, 0.8, 1.25, 0.65, 1.5, 0.5, 2};
  std::vector<Vector2d> rim = rimOf(target.extent, kRimStep);
  if (const auto nearest = nearestPoint(target.extent, start)) rim.insert(rim.begin(), *nearest);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& edge : rim) least = std::min(least, (edge - start).norm());
  std::vector<Candidate> candidates;
  for (const auto& edge : rim) {
    const Side side = sideOf(target, edge, start);
    const int turns = static_cast<int>(std::lround(side.most_turn / kTurnStep));
    for (int turn = -turns; turn <= turns; ++turn) {
      const Vector2d direction = turned(side.direction, turn * kTurnStep);
      for (const double factor : kFactors) {
        const double distance = factor * wanted;
        const double cost = (edge - start).norm() - least + kOfDistance * std::abs(distance - wanted) +
                            kOfTurn * std::abs(turn) * kTurnStep;
        candidates.push_back({edge + distance * direction, edge, cost});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return candidates;
}

// Whether the candidate does not stand in the target, and the edge that it faces is the nearest one or nearly so.
bool standsBefore(const map::Place& target, const Candidate& candidate) {
  constexpr double kNearly = 0.8;
  const auto nearest = nearestPoint(target.extent, candidate.at);
  return nearest && (*nearest - candidate.at).norm() >= kNearly * (candidate.edge - candidate.at).norm();
}

// The wall that a sign hangs on is occupied in the grid, and neither is placed to the centimetre: this length [m]
// before the target is not checked.
double toleranceOf(const map::Place& target, const GridMap& grid) {
  constexpr double kLeast = 0.2, kMost = 0.5, kSigmas = 2;
  const double of_sigma = target.sigma ? kSigmas * *target.sigma : 0;
  return std::clamp(3 * grid.resolution + of_sigma, kLeast, kMost);
}

}  // namespace

std::optional<Goal> goalBefore(const map::Place& target, const Vector2d& start, const RoomToMove& room,
                               const GridMap& grid, const GoalOptions& options) {
  const double tolerance = toleranceOf(target, grid);
  std::optional<Goal> unconnected;
  for (const auto& candidate : candidatesBefore(target, start, options.distance)) {
    const Eigen::Vector2i cell = grid.cellOf(candidate.at);
    const bool is_connected = room.isReached(cell);
    if ((!is_connected && unconnected) || !room.fits(cell) || !standsBefore(target, candidate) ||
        !room.isSeen(candidate.at, candidate.edge, tolerance))
      continue;
    const Vector2d towards = candidate.edge - candidate.at;
    const Goal goal{candidate.at.x(), candidate.at.y(), std::atan2(towards.y(), towards.x()),
                    candidate.edge,   towards.norm(),   is_connected};
    if (is_connected) return goal;
    unconnected = goal;
  }
  return unconnected;
}

}  // namespace omnimapper::query
