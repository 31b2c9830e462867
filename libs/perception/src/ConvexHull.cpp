#include "ConvexHull.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <array>

namespace omnimapper::perception {

namespace {

constexpr std::size_t kWorthDropping = 64;    // with fewer points, sorting is cheaper than dropping
constexpr std::size_t kExtremeSample = 1024;  // most points that are searched for extreme ones

// Convex polygon of the points that are farthest in eight directions, among a sample of all points.
std::vector<Eigen::Vector2d> extremes(const std::vector<Eigen::Vector2d>& points) {
  std::array<Eigen::Vector2d, 8> farthest;
  farthest.fill(points.front());
  const auto along = [](std::size_t direction, const Eigen::Vector2d& p) {
    const double value[4] = {p.x(), p.y(), p.x() + p.y(), p.x() - p.y()};
    return direction < 4 ? value[direction] : -value[direction - 4];
  };
  const std::size_t step = (points.size() - 1) / kExtremeSample + 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Eigen::Vector2d& point = points[i];
    for (std::size_t d = 0; d < farthest.size(); ++d) {
      if (along(d, point) > along(d, farthest[d])) farthest[d] = point;
    }
  }
  return geometry::convexHull({farthest.begin(), farthest.end()});
}

}  // namespace

std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
  if (points.size() > kWorthDropping) {
    const HullNeighbourhood inside(extremes(points));
    // A point that is inside by more than rounding errors is no corner.
    constexpr double kWithin = 1e-9;
    const auto isInner = [&](const Eigen::Vector2d& point) { return inside.holds(point, -kWithin); };
    points.erase(std::remove_if(points.begin(), points.end(), isInner), points.end());
  }
  return geometry::convexHull(std::move(points));
}

HullNeighbourhood::HullNeighbourhood(const std::vector<Eigen::Vector2d>& corners) {
  if (corners.size() < 3) return;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d edge = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    const Eigen::Vector2d inwards(-edge.y(), edge.x());
    sides_.push_back({inwards, inwards.dot(corners[i])});
  }
}

}  // namespace omnimapper::perception
