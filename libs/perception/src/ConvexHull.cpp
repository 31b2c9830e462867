#include "ConvexHull.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <array>

namespace omnimapper::perception {

namespace {

constexpr std::size_t kWorthDropping = 64;    // sorting fewer costs less than looking for the inner ones
constexpr std::size_t kExtremeSample = 1024;  // points among which extreme ones are sought

// The farthest points in eight directions among some of all, as a convex polygon.
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
    // What lies within by more than rounding is no corner.
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
