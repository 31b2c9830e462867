#include "alignBorders.h"

#include <omnimapper/geometry/motionBetween.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;
using Loops = std::vector<std::vector<Vector2d>>;

// Points of all borders, the same distance apart: at least 0.2 m, and so far that there are not many of them.
std::vector<Vector2d> borderPoints(const Loops& loops) {
  constexpr double kStep = 0.2, kMost = 800;
  double length = 0;
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  const double step = std::max(kStep, length / kMost);
  std::vector<Vector2d> points;
  double until_next = 0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d edge = loop[(i + 1) % loop.size()] - loop[i];
      const double size = edge.norm();
      for (; until_next < size; until_next += step) points.push_back(loop[i] + until_next / size * edge);
      until_next -= size;
    }
  }
  return points;
}

// Finds the nearest of some points.
class NearPoints {
 public:
  explicit NearPoints(const std::vector<Vector2d>& points) {
    for (const Vector2d& point : points) cells_[cellOf(point)].push_back(point);
  }
  std::optional<Vector2d> nearest(const Vector2d& point, double within) const {
    std::optional<Vector2d> found;
    const auto [x, y] = cellOf(point);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto cell = cells_.find({x + dx, y + dy});
        if (cell == cells_.end()) continue;
        for (const Vector2d& other : cell->second) {
          if ((other - point).norm() > within) continue;
          within = (other - point).norm();
          found = other;
        }
      }
    }
    return found;
  }

 private:
  static constexpr double kCell = 0.5;  // [m] the largest distance that is asked for
  static std::pair<int, int> cellOf(const Vector2d& point) {
    return {static_cast<int>(std::floor(point.x() / kCell)), static_cast<int>(std::floor(point.y() / kCell))};
  }
  std::map<std::pair<int, int>, std::vector<Vector2d>> cells_;
};

double shareNear(const std::vector<Vector2d>& points, const geometry::Se2& motion, const NearPoints& others) {
  constexpr double kNear = 0.15;  // [m]
  if (points.empty()) return 0;
  const auto near = std::count_if(points.begin(), points.end(), [&](const Vector2d& point) {
    return others.nearest(motion * point, kNear).has_value();
  });
  return static_cast<double>(near) / static_cast<double>(points.size());
}

// The direction of most walls, modulo a right angle [rad].
double mainDirection(const Loops& loops) {
  constexpr int kBins = 90;
  std::array<double, kBins> lengths{};
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d edge = loop[(i + 1) % loop.size()] - loop[i];
      const double turn = std::atan2(edge.y(), edge.x()) / (M_PI / 2);  // right angles
      const double part = turn - std::floor(turn);
      lengths[std::min(kBins - 1, static_cast<int>(part * kBins))] += edge.norm();
    }
  }
  double most = -1;
  int best = 0;
  for (int i = 0; i < kBins; ++i) {
    const double sum = lengths[(i + kBins - 1) % kBins] + lengths[i] + lengths[(i + 1) % kBins];
    if (sum <= most) continue;
    most = sum;
    best = i;
  }
  return (best + 0.5) / kBins * M_PI / 2;
}

// The shifts [m] after a turn for which most pairs of points coincide, the best first.
std::vector<Vector2d> likelyShifts(const std::vector<Vector2d>& then, const std::vector<Vector2d>& now,
                                   const geometry::Se2& turn) {
  constexpr double kBin = 0.3;  // [m]
  constexpr std::size_t kMost = 5;
  std::map<std::pair<int, int>, int> votes;
  for (const Vector2d& a : then) {
    const Vector2d turned = turn * a;
    for (const Vector2d& b : now) {
      const Vector2d shift = (b - turned) / kBin;
      ++votes[{static_cast<int>(std::lround(shift.x())), static_cast<int>(std::lround(shift.y()))}];
    }
  }
  std::vector<std::pair<int, Vector2d>> sums;
  for (const auto& [bin, count] : votes) {
    int sum = 0;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if (const auto other = votes.find({bin.first + dx, bin.second + dy}); other != votes.end())
          sum += other->second;
    sums.emplace_back(sum, kBin * Vector2d(bin.first, bin.second));
  }
  const auto end = sums.begin() + static_cast<std::ptrdiff_t>(std::min(kMost, sums.size()));
  std::partial_sort(sums.begin(), end, sums.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(-a.first, a.second.x(), a.second.y()) <
           std::make_tuple(-b.first, b.second.x(), b.second.y());
  });
  std::vector<Vector2d> shifts;
  for (auto it = sums.begin(); it != end; ++it) shifts.push_back(it->second);
  return shifts;
}

}  // namespace

double scoreByBorders(const Loops& then, const Loops& now, const geometry::Se2& motion) {
  const auto points = borderPoints(then), others = borderPoints(now);
  return 0.5 * (shareNear(points, motion, NearPoints(others)) + shareNear(others, inverse(motion), NearPoints(points)));
}

BorderAlignment refinedByBorders(const Loops& then, const Loops& now, const geometry::Se2& motion) {
  constexpr std::size_t kFewest = 10;
  const auto points = borderPoints(then), others = borderPoints(now);
  const NearPoints near_now(others);
  BorderAlignment result{motion, 0};
  for (const double within : {0.5, 0.4, 0.3, 0.2, 0.2}) {  // [m]
    std::vector<std::pair<Vector2d, Vector2d>> pairs;
    for (const Vector2d& point : points)
      if (const auto other = near_now.nearest(result.now_from_then * point, within)) pairs.emplace_back(point, *other);
    if (pairs.size() < kFewest) break;
    result.now_from_then = geometry::motionBetween(pairs);
  }
  result.score = scoreByBorders(then, now, result.now_from_then);
  return result;
}

std::vector<geometry::Se2> motionsByBorders(const Loops& then, const Loops& now) {
  const auto points = borderPoints(then), others = borderPoints(now);
  const double first = mainDirection(now) - mainDirection(then);
  std::vector<geometry::Se2> motions;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const geometry::Se2 turn{0, 0, geometry::wrapToPi(first + quarter * M_PI / 2)};
    for (const Vector2d& shift : likelyShifts(points, others, turn))
      motions.push_back({shift.x(), shift.y(), turn.yaw});
  }
  return motions;
}

}  // namespace omnimapper::building
