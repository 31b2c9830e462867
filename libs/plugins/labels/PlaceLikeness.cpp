#include "PlaceLikeness.h"

#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/query/Distance.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

using Eigen::Vector2d;

bool hasRim(const map::Place& place) {
  return !place.extent.lines.empty() || !place.extent.outlines.empty();
}

// The share of the rim of one place that is near to the other.
double shareNear(const map::Place& of, const map::Place& to) {
  constexpr double kStep = 0.1, kNear = 0.2;  // [m]
  const auto rim = query::rimOf(of.extent, kStep);
  if (rim.empty()) return 0;
  const auto isNear = [&](const Vector2d& point) {
    const auto nearest = query::nearestPoint(to.extent, point);
    return nearest && (*nearest - point).norm() <= kNear;
  };
  return static_cast<double>(std::count_if(rim.begin(), rim.end(), isNear)) / static_cast<double>(rim.size());
}

// Whether the tops or the bottoms are at the same height: of walls and objects only a part may have been seen.
bool haveHeightInCommon(const map::Place& a, const map::Place& b) {
  constexpr double kSame = 0.15;  // [m]
  const double bottom = std::abs(a.extent.bottom - b.extent.bottom), top = std::abs(a.extent.top - b.extent.top);
  const double common = std::min(a.extent.top, b.extent.top) - std::max(a.extent.bottom, b.extent.bottom);
  return bottom <= kSame || top <= kSame || common > kSame;
}

// Thin walls have two sides.
bool haveSidesInCommon(const map::Place& a, const map::Place& b) {
  constexpr double kAlike = 0.7;
  return !a.normal || !b.normal || a.normal->dot(*b.normal) >= kAlike;
}

// Of a table top, half may not have been seen. The length of a wall says nothing.
bool haveSizeInCommon(const map::Place& a, const map::Place& b) {
  constexpr double kMost = 2, kNone = 0.05;  // [m^2]
  const auto areaOf = [](const map::Place& place) {
    double sum = 0;
    for (const auto& outline : place.extent.outlines) sum += std::abs(geometry::area(outline));
    return sum;
  };
  const double area = areaOf(a), other = areaOf(b);
  return std::max(area, other) <= std::max(kMost * std::min(area, other), kNone);
}

}  // namespace

double sizeOf(const map::Place& place) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : query::rimOf(place.extent, 1)) box.extend(point);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

map::Place movedPlace(const geometry::Se2& there_from_here, map::Place place) {
  const auto move = [&](Vector2d& point) { point = there_from_here * point; };
  auto& extent = place.extent;
  std::for_each(extent.points.begin(), extent.points.end(), move);
  for (auto& [from, to] : extent.lines) move(from), move(to);
  for (auto* loops : {&extent.outlines, &extent.holes})
    for (auto& loop : *loops) std::for_each(loop.begin(), loop.end(), move);
  place.position.head<2>() = there_from_here * Vector2d(place.position.head<2>());
  for (auto* direction : {&place.normal, &place.seen_from})
    if (*direction) (*direction)->head<2>() = (there_from_here.rotation() * (*direction)->head<2>()).eval();
  return place;
}

double likenessOf(const map::Place& a, const map::Place& b) {
  constexpr double kOtherClass = 0.6, kSmall = 1;  // [m]
  const bool same_class = a.kind == b.kind;
  if (!same_class && !(hasRim(a) && hasRim(b) && a.normal.has_value() == b.normal.has_value())) return 0;
  if (!haveHeightInCommon(a, b) || !haveSidesInCommon(a, b) || !haveSizeInCommon(a, b)) return 0;
  const double like = std::sqrt(shareNear(a, b) * shareNear(b, a)) * (same_class ? 1 : kOtherClass);
  // Of small things the one whose middle is nearest is meant.
  if (sizeOf(a) > kSmall || sizeOf(b) > kSmall) return like;
  constexpr double kOff = 0.15;  // [m]
  const double off = (a.position - b.position).head<2>().norm() / kOff;
  return like * std::exp(-0.5 * off * off);
}

}  // namespace omnimapper::plugins
