#include "omnimapper/surfaces/SurfaceFacts.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>

#include "SurfaceCells.h"
#include "Touching.h"

namespace omnimapper::surfaces {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Lie lieOf(const geometry::Plane3& plane) {
  constexpr double kLevel = 0.95, kUpright = 0.2;  // z of the normal
  const double up = plane.normal.z();
  return up > kLevel ? Lie::up : up < -kLevel ? Lie::down : std::abs(up) < kUpright ? Lie::upright : Lie::leaning;
}

// Sides of the smallest rectangle around the cells as seen from above, longer side first.
Vector2d leastRectangle(const std::vector<Vector3d>& cells) {
  constexpr int kDirections = 18;
  Vector2d best(1e300, 1e300);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = M_PI / 2 * i / kDirections;
    const Vector2d u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
    const Vector2d on_u = rangeAlong(cells, onFloor(u)), on_v = rangeAlong(cells, onFloor(v));
    const Vector2d size(on_u.y() - on_u.x(), on_v.y() - on_v.x());
    if (size.prod() < best.prod()) best = {size.maxCoeff(), size.minCoeff()};
  }
  return best;
}

SurfaceFacts factsOf(const Surface& surface, double floor) {
  SurfaceFacts facts;
  facts.lie = lieOf(surface.plane);
  if (cornersOf(surface).empty()) return facts;
  const auto [cells, area] = cellsOf(surface);
  std::vector<Vector2d> from_above;
  for (const auto& cell : cells) {
    from_above.push_back(cell.head<2>());
    facts.middle += cell / static_cast<double>(cells.size());
  }
  facts.plan = geometry::convexHull(std::move(from_above));
  const Vector2d heights = rangeAlong(cells, Vector3d::UnitZ());
  facts.bottom = heights.x() - floor;
  facts.top = heights.y() - floor;
  if (facts.lie == Lie::upright) {
    facts.along = rangeAlong(cells, onFloor(alongFloor(surface.plane)));
    facts.longer = facts.along.y() - facts.along.x();
    facts.shorter = facts.top - facts.bottom;
  } else {
    const Vector2d sides = leastRectangle(cells);
    facts.longer = sides.x();
    facts.shorter = sides.y();
  }
  const double around = facts.longer * facts.shorter;
  facts.filled = around > 0 ? std::min(1.0, area / around) : 0;
  return facts;
}

// Distance of `behind`, if it may be a wall behind the surface that continues beside or above it; 0 if it is none or
// far.
double wallBehind(const Surface& surface, const SurfaceFacts& facts, const Surface& behind,
                  const SurfaceFacts& of_behind) {
  constexpr double kNear = 0.12, kFar = 0.95, kBeside = 0.5, kLow = 0.4, kLeastWall = 1;  // [m]
  constexpr double kMuch = 0.8;
  if (of_behind.lie != Lie::upright || behind.plane.normal.dot(surface.plane.normal) < 0.97) return 0;
  const double before = signedDistance(behind.plane, facts.middle);
  if (before < kNear || before > kFar || of_behind.top < facts.top - kLow) return 0;
  if (of_behind.longer < std::max(kLeastWall, kMuch * facts.longer)) return 0;
  // Both directions along the floor are nearly the same.
  const bool is_there =
      of_behind.along.x() < facts.along.y() + kBeside && of_behind.along.y() > facts.along.x() - kBeside;
  return is_there ? before : 0;
}

bool isLow(const SurfaceFacts& facts) {
  return facts.lie == Lie::up && facts.bottom > 0.33 && facts.top < 0.68 && facts.shorter > 0.3;
}
bool isBed(const SurfaceFacts& facts) {
  return isLow(facts) && facts.longer > 1.75 && facts.shorter > 0.75;
}

// Adds the facts about a surface that touches it.
void addTouching(const Surface& surface, const Surface& other, const SurfaceFacts& of_other, SurfaceFacts& facts) {
  constexpr double kHighestSeat = 0.53;  // [m]
  if (isLow(of_other)) {
    if (isBed(of_other)) {
      facts.is_at_bed = true;
    } else if (of_other.top < kHighestSeat) {
      facts.is_at_seat = true;
    }
  }
  if (facts.lie != Lie::upright) return;
  if (of_other.lie == Lie::up && std::abs((of_other.bottom + of_other.top) / 2 - facts.top) < kTouch &&
      of_other.longer * of_other.shorter > facts.top_longer * facts.top_shorter) {
    facts.top_longer = of_other.longer;
    facts.top_shorter = of_other.shorter;
  }
  if (!meetAtEnd(surface, facts, other, of_other)) return;
  const bool is_behind = liesBehind(surface, of_other), is_seen_behind = liesBehind(other, facts);
  facts.has_outer_corner = facts.has_outer_corner || (is_behind && is_seen_behind);
  facts.has_inner_corner = facts.has_inner_corner || (!is_behind && !is_seen_behind);
}

// Whether another upright surface is near and on the same plane, as parts of one wall on both sides of a door.
bool liesOnPlane(const Surface& surface, const SurfaceFacts& facts, const Surface& other,
                 const SurfaceFacts& of_other) {
  constexpr double kAlong = 0.99, kOff = 0.06, kFar = 2;  // cosine of the angle between normals, [m], [m]
  return of_other.lie == Lie::upright && surface.plane.normal.dot(other.plane.normal) > kAlong &&
         std::abs(signedDistance(surface.plane, of_other.middle)) < kOff &&
         of_other.along.x() < facts.along.y() + kFar && of_other.along.y() > facts.along.x() - kFar;
}

void addNeighbours(const std::vector<Surface>& surfaces, std::vector<SurfaceFacts>& all) {
  std::vector<Vector2d> widths;
  for (const auto& facts : all) widths.push_back(facts.along);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SurfaceFacts& facts = all[i];
    for (std::size_t j = 0; j < all.size(); ++j) {
      const SurfaceFacts& other = all[j];
      if (i == j || facts.plan.empty() || other.plan.empty()) continue;
      if (facts.lie == Lie::upright) {
        const double behind = wallBehind(surfaces[i], facts, surfaces[j], other);
        if (behind > 0 && (facts.before_wall == 0 || behind < facts.before_wall)) facts.before_wall = behind;
        if (liesOnPlane(surfaces[i], facts, surfaces[j], other)) {
          widths[i].x() = std::min(widths[i].x(), other.along.x());
          widths[i].y() = std::max(widths[i].y(), other.along.y());
        }
      }
      if (geometry::distance(facts.plan, other.plan) > kTouch) continue;
      if (overlapInHeight(facts, other)) addTouching(surfaces[i], surfaces[j], other, facts);
      const double of_other = (other.bottom + other.top) / 2;
      if (other.lie == Lie::up && facts.lie == Lie::upright && of_other > 0.3) {
        facts.is_below_level = facts.is_below_level || of_other > facts.top;
        facts.is_on_level = facts.is_on_level || std::abs(of_other - facts.bottom) < kTouch;
      }
      if (facts.lie == Lie::up && other.lie == Lie::upright)
        facts.has_front = facts.has_front || std::abs(other.top - (facts.bottom + facts.top) / 2) < kTouch;
    }
    facts.plane_width = widths[i].y() - widths[i].x();
  }
}

}  // namespace

std::vector<SurfaceFacts> factsOf(const std::vector<Surface>& surfaces, double floor) {
  std::vector<SurfaceFacts> all;
  for (const auto& surface : surfaces) all.push_back(factsOf(surface, floor));
  addNeighbours(surfaces, all);
  return all;
}

}  // namespace omnimapper::surfaces
