#include "omnimapper/geometry/Simplify.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace omnimapper::geometry {

namespace {

using Points = std::vector<Eigen::Vector2d>;
using Stretch = std::pair<std::size_t, std::size_t>;

double squaredDistanceFromStretch(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                                  const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from, offset = point - from;
  const double squared_length = along.squaredNorm();
  const double share = squared_length > 0 ? std::clamp(offset.dot(along) / squared_length, 0., 1.) : 0;
  return (offset - share * along).squaredNorm();
}

// Splits each stretch at its farthest point while that is farther than the tolerance. The end of a stretch may be
// points.size(), which is the first point again.
std::vector<bool> keepFarthest(const Points& points, std::vector<Stretch> stretches, double tolerance) {
  std::vector<bool> kept(points.size(), false);
  for (const auto& [from, to] : stretches) kept[from] = kept[to % points.size()] = true;
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    std::size_t farthest = from;
    double distance = tolerance * tolerance;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = squaredDistanceFromStretch(points[i], points[from], points[to % points.size()]);
      if (d > distance) distance = d, farthest = i;
    }
    if (farthest == from) continue;
    kept[farthest] = true;
    stretches.emplace_back(from, farthest);
    stretches.emplace_back(farthest, to);
  }
  return kept;
}

std::vector<std::size_t> indicesOf(const std::vector<bool>& kept) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) indices.push_back(i);
  }
  return indices;
}

}  // namespace

std::vector<std::size_t> keptOfLine(const Points& points, double tolerance) {
  if (points.empty()) return {};
  return indicesOf(keepFarthest(points, {{0, points.size() - 1}}, tolerance));
}

std::vector<std::size_t> keptOfLoop(const Points& points, double tolerance) {
  std::vector<std::size_t> all(points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (points.size() < 4 || tolerance <= 0) return all;
  // A point and the one farthest from it are kept; between them either half is an open line.
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - points[0]).squaredNorm() > (points[opposite] - points[0]).squaredNorm()) opposite = i;
  }
  const auto kept = indicesOf(keepFarthest(points, {{0, opposite}, {opposite, points.size()}}, tolerance));
  return kept.size() < 3 ? all : kept;
}

}  // namespace omnimapper::geometry
