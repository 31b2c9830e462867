#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/Segment2.h>

#include <algorithm>
#include <limits>

namespace omnimapper::geometry {

namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool isInside(const Points& polygon, const Eigen::Vector2d& p) {
  if (polygon.size() < 3) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (cross(b - a, p - a) < 0) return false;
  }
  return true;
}

bool doCross(const Segment2& a, const Segment2& b) {
  const auto parted = [](const Segment2& line, const Segment2& ends) {
    const Eigen::Vector2d along = line.to - line.from;
    return cross(along, ends.from - line.from) * cross(along, ends.to - line.from) < 0;
  };
  return parted(a, b) && parted(b, a);
}

}  // namespace

Points convexHull(Points points) {
  // Andrew's monotone chain.
  const auto less = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto half = [](const Points& sorted) {
    Points chain;
    for (const auto& p : sorted) {
      while (chain.size() > 1 && cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();  // the other half begins with it
    return chain;
  };
  Points hull = half(points);
  std::reverse(points.begin(), points.end());
  const Points upper = half(points);
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

double area(const Points& polygon) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    doubled += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return doubled / 2;
}

double distance(const Points& a, const Points& b) {
  if (isInside(a, b.front()) || isInside(b, a.front())) return 0;
  double least = std::numeric_limits<double>::max();
  const auto edge = [](const Points& polygon, std::size_t i) {
    return Segment2{polygon[i], polygon[(i + 1) % polygon.size()]};
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Segment2 of_a = edge(a, i), of_b = edge(b, j);
      if (doCross(of_a, of_b)) return 0;
      least = std::min({least, distance(of_a, of_b.from), distance(of_b, of_a.from)});
    }
  }
  return least;
}

}  // namespace omnimapper::geometry
