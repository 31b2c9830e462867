#include "omnimapper/geometry/PolygonBooleans.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <polyclipping/clipper.hpp>

#include "omnimapper/geometry/Simplify.h"

namespace omnimapper::geometry {

namespace {

using ClipperLib::Path;
using ClipperLib::Paths;
using Points = std::vector<Eigen::Vector2d>;

constexpr double kUnit = 1e-6;       // [m] Clipper computes in whole numbers, exactly
constexpr double kFarthest = 1e6;    // [m]
constexpr double kStraight = 0.005;  // [m]

bool isSomewhere(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Eigen::Vector2d& point) {
    return point.allFinite() && point.cwiseAbs().maxCoeff() <= kFarthest;
  });
}

// Empty if a point is not finite or too far away.
Path pathOf(const Points& points) {
  Path path;
  if (!isSomewhere(points)) return path;
  for (const auto& point : points) path.emplace_back(std::llround(point.x() / kUnit), std::llround(point.y() / kUnit));
  return path;
}

// The points of a path without corners in the middle of an edge, which Clipper leaves where polygons met.
Points pointsOf(const Path& path) {
  Points points, corners;
  for (const auto& corner : path)
    points.emplace_back(kUnit * static_cast<double>(corner.X), kUnit * static_cast<double>(corner.Y));
  for (const std::size_t i : keptOfLoop(points, kUnit)) corners.push_back(points[i]);
  return corners;
}

// Outlines counter-clockwise, holes clockwise.
Paths combined(ClipperLib::ClipType how, const Paths& subject, const Paths& clip) {
  ClipperLib::Clipper clipper(ClipperLib::ioStrictlySimple);
  // AddPaths() is false if nothing has an area; Execute() would fail then.
  if (!clipper.AddPaths(subject, ClipperLib::ptSubject, true)) return {};
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths result;
  if (!clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero))
    throw base::Error(base::ExitCode::internal, "polygons cannot be combined");
  return result;
}

// All that the polygon goes around, in either sense of rotation.
Paths areasOf(const Points& points) {
  if (!isSomewhere(points)) return {};
  Points corners;
  for (const std::size_t i : keptOfLoop(points, kStraight)) corners.push_back(points[i]);
  return combined(ClipperLib::ctUnion, {pathOf(corners)}, {});
}

// Unites pairs, then pairs of these, because most edges are gone before many polygons meet.
Paths unionOfParts(std::vector<Paths> parts) {
  while (parts.size() > 1) {
    std::vector<Paths> pairs;
    for (std::size_t i = 0; i < parts.size(); i += 2) {
      if (i + 1 == parts.size()) {
        pairs.push_back(std::move(parts[i]));
        continue;
      }
      std::move(parts[i + 1].begin(), parts[i + 1].end(), std::back_inserter(parts[i]));
      pairs.push_back(combined(ClipperLib::ctUnion, parts[i], {}));
    }
    parts = std::move(pairs);
  }
  return parts.empty() ? Paths() : std::move(parts.front());
}

// The area within the outline, less the holes.
Paths areasOf(const HoledPolygon2& polygon) {
  Paths holes;
  for (const auto& hole : polygon.holes) {
    Paths more = areasOf(hole);
    std::move(more.begin(), more.end(), std::back_inserter(holes));
  }
  Paths areas = areasOf(polygon.outline);
  return holes.empty() ? areas : combined(ClipperLib::ctDifference, areas, holes);
}

Areas2 asAreas(const Paths& paths, double least) {
  double largest = 0;
  for (const auto& path : paths) largest = std::max(largest, kUnit * kUnit * ClipperLib::Area(path));
  Areas2 areas;
  for (const auto& path : paths) {
    const double area = kUnit * kUnit * ClipperLib::Area(path);  // negative for holes
    if (std::abs(area) < std::min(least, largest)) continue;
    (area > 0 ? areas.outlines : areas.holes).push_back(pointsOf(path));
  }
  return areas;
}

}  // namespace

Areas2 unionOf(const std::vector<HoledPolygon2>& polygons, double least) {
  std::vector<Paths> parts;
  for (const auto& polygon : polygons) parts.push_back(areasOf(polygon));
  return asAreas(unionOfParts(std::move(parts)), least);
}

Areas2 intersectionOf(const HoledPolygon2& polygon, const std::vector<Eigen::Vector2d>& within) {
  return asAreas(combined(ClipperLib::ctIntersection, areasOf(polygon), areasOf(within)), 0);
}

}  // namespace omnimapper::geometry
