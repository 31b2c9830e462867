#include <omnimapper/sim_world/Triangulate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;

// Twice the area of a triangle, positive if counter-clockwise; 0 if only rounding makes it differ from that.
double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  return std::abs(area) < 1e-12 ? 0 : area;
}

// A ring that visits points by number; where a hole was joined, a point is visited twice.
using Corners = std::vector<int>;

Corners walkOf(const Ring& ring, int first, bool counter_clockwise) {
  Corners walk(ring.size());
  std::iota(walk.begin(), walk.end(), first);
  if ((doubleArea(ring) > 0) != counter_clockwise) std::reverse(walk.begin(), walk.end());
  return walk;
}

bool isInside(const Vector2d& p, const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

// Joins a hole, given clockwise, by a cut from its rightmost point to a point of the outer walk that is visible from
// there past the other holes. There is such a point to the right of a hole if no other hole reaches farther to the
// right.
void joinHole(const std::vector<Vector2d>& points, const std::vector<Corners>& holes, Corners hole, Corners& outer) {
  const auto rightmost = std::max_element(hole.begin(), hole.end(), [&](int i, int j) {
    return points[i].x() < points[j].x() || (points[i].x() == points[j].x() && points[i].y() < points[j].y());
  });
  std::rotate(hole.begin(), rightmost, hole.end());
  const Vector2d& from = points[hole.front()];
  // Takes the nearest point of the outer walk that is visible from the hole's point.
  const auto sees = [&](std::size_t at) {
    const Vector2d& to = points[outer[at]];
    const Vector2d& before = points[outer[(at + outer.size() - 1) % outer.size()]];
    const Vector2d& after = points[outer[(at + 1) % outer.size()]];
    const bool convex = cross(before, to, after) > 0;
    const bool left_of_first = cross(before, to, from) > 0, left_of_second = cross(to, after, from) > 0;
    if (convex ? !(left_of_first && left_of_second) : !(left_of_first || left_of_second)) return false;
    const auto crosses = [&](const Corners& walk) {
      for (std::size_t i = 0; i < walk.size(); ++i) {
        const Vector2d &a = points[walk[i]], &b = points[walk[(i + 1) % walk.size()]];
        if (a == to || b == to || a == from || b == from) continue;
        if (cross(from, to, a) * cross(from, to, b) <= 0 && cross(a, b, from) * cross(a, b, to) <= 0) return true;
      }
      return false;
    };
    return !crosses(outer) && std::none_of(holes.begin(), holes.end(), crosses);
  };
  std::size_t best = outer.size();
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const double distance = (points[outer[i]] - from).squaredNorm();
    if (distance < best_distance && sees(i)) {
      best = i;
      best_distance = distance;
    }
  }
  if (best == outer.size()) throw std::invalid_argument("triangulate: a hole lies outside of its outline");
  hole.push_back(hole.front());
  hole.push_back(outer[best]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(best) + 1, hole.begin(), hole.end());
}

std::vector<std::array<int, 3>> clipEars(const std::vector<Vector2d>& points, Corners walk) {
  std::vector<std::array<int, 3>> triangles;
  while (walk.size() >= 3) {
    bool clipped = false;
    for (std::size_t i = 0; i < walk.size() && !clipped; ++i) {
      const int before = walk[(i + walk.size() - 1) % walk.size()], at = walk[i], after = walk[(i + 1) % walk.size()];
      const Vector2d &a = points[before], &b = points[at], &c = points[after];
      const double area = cross(a, b, c);
      // A point on a straight line or the tip of a spike is removed without a triangle.
      const bool is_flat = area == 0;
      const bool blocked = !is_flat && std::any_of(walk.begin(), walk.end(), [&](int j) {
        return points[j] != a && points[j] != b && points[j] != c && isInside(points[j], a, b, c);
      });
      if (area < 0 || blocked) continue;
      if (is_flat && walk.size() > 3 && a != c && (b - a).dot(c - b) > 0) {
        // A point on a straight line must stay a corner of a triangle, or its neighbours would meet in a T.
        const bool others = std::any_of(walk.begin(), walk.end(), [&](int j) { return cross(a, c, points[j]) != 0; });
        if (others) continue;
      }
      if (!is_flat) triangles.push_back({before, at, after});
      walk.erase(walk.begin() + static_cast<std::ptrdiff_t>(i));
      clipped = true;
    }
    if (!clipped) throw std::invalid_argument("triangulate: the outline crosses itself");
  }
  return triangles;
}

}  // namespace

double doubleArea(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::vector<std::array<int, 3>> triangulate(const std::vector<Ring>& rings) {
  std::vector<Vector2d> points;
  std::vector<Corners> holes;
  Corners outer;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i].size() < 3 || doubleArea(rings[i]) == 0) throw std::invalid_argument("triangulate: an empty ring");
    const Corners walk = walkOf(rings[i], static_cast<int>(points.size()), i == 0);
    points.insert(points.end(), rings[i].begin(), rings[i].end());
    if (i == 0) {
      outer = walk;
    } else {
      holes.push_back(walk);
    }
  }
  const auto right = [&](const Corners& walk) {
    double x = -std::numeric_limits<double>::infinity();
    for (const int i : walk) x = std::max(x, points[i].x());
    return x;
  };
  std::stable_sort(holes.begin(), holes.end(), [&](const Corners& a, const Corners& b) { return right(a) > right(b); });
  for (const Corners& hole : holes) joinHole(points, holes, hole, outer);
  return clipEars(points, outer);
}

}  // namespace omnimapper::sim
