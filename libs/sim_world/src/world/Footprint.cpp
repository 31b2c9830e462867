#include <omnimapper/sim_world/Footprint.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether a line along an edge of `a` separates both rings.
bool isSeparatedByEdges(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Vector2d outward = Vector2d(edge.y(), -edge.x()).normalized();
    const bool beyond =
        std::all_of(b.begin(), b.end(), [&](const Vector2d& p) { return outward.dot(p - a[i]) > -kFloorTolerance; });
    if (beyond) return true;
  }
  return false;
}

std::vector<Ring> trianglesOf(const Ring& ring) {
  std::vector<Ring> result;
  for (const auto& t : triangulate({ring})) result.push_back({ring[t[0]], ring[t[1]], ring[t[2]]});
  return result;
}

// Length of the part of a segment that lies inside a convex ring.
double lengthInside(const Ring& convex, const Vector2d& a, const Vector2d& b) {
  double from = 0, to = 1;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vector2d edge = convex[(i + 1) % convex.size()] - convex[i];
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    const double at_a = inward.dot(a - convex[i]) - kFloorTolerance, at_b = inward.dot(b - convex[i]) - kFloorTolerance;
    if (at_a <= 0 && at_b <= 0) return 0;
    if (at_a < 0) from = std::max(from, at_a / (at_a - at_b));
    if (at_b < 0) to = std::min(to, at_a / (at_a - at_b));
  }
  return std::max(0.0, to - from) * (b - a).norm();
}

}  // namespace

Ring rectangle(const Vector2d& centre, double length, double width, double yaw) {
  const Vector2d x = Vector2d(std::cos(yaw), std::sin(yaw)) * length / 2;
  const Vector2d y = Vector2d(-std::sin(yaw), std::cos(yaw)) * width / 2;
  return {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
}

Ring rectangle(const Vector2d& low, const Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

Bounds boundsOf(const Ring& ring) {
  Bounds bounds{ring.front(), ring.front()};
  for (const Vector2d& p : ring) {
    bounds.low = bounds.low.cwiseMin(p);
    bounds.high = bounds.high.cwiseMax(p);
  }
  return bounds;
}

double distanceToSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d segment = b - a;
  const double share =
      segment.squaredNorm() > 0 ? std::clamp(segment.dot(point - a) / segment.squaredNorm(), 0.0, 1.0) : 0.0;
  return (point - a - share * segment).norm();
}

bool contains(const Ring& ring, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (distanceToSegment(point, a, b) <= kFloorTolerance) return true;
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool convexOverlap(const Ring& a, const Ring& b) {
  return !isSeparatedByEdges(a, b) && !isSeparatedByEdges(b, a);
}

bool overlap(const Ring& a, const Ring& b) {
  const auto triangles_of_b = trianglesOf(b);
  for (const Ring& of_a : trianglesOf(a)) {
    for (const Ring& of_b : triangles_of_b) {
      if (convexOverlap(of_a, of_b)) return true;
    }
  }
  return false;
}

bool isWithin(const Ring& convex, const Ring& ring) {
  for (const Vector2d& p : convex) {
    if (!contains(ring, p)) return false;
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (lengthInside(convex, ring[i], ring[(i + 1) % ring.size()]) > kFloorTolerance) return false;
  }
  return true;
}

bool isSimple(const Ring& ring) {
  const auto n = ring.size();
  if (n < 3) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % n];
    if ((b - a).norm() <= kFloorTolerance) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours around the end
      const Vector2d &c = ring[j], &d = ring[(j + 1) % n];
      const bool crosses =
          cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
      if (crosses || distanceToSegment(c, a, b) <= kFloorTolerance || distanceToSegment(d, a, b) <= kFloorTolerance)
        return false;
    }
  }
  return true;
}

bool overlap(const Footprint& a, const Footprint& b) {
  return a.low_z < b.high_z - kFloorTolerance && b.low_z < a.high_z - kFloorTolerance &&
         convexOverlap(a.outline_in_map, b.outline_in_map);
}

}  // namespace omnimapper::sim
