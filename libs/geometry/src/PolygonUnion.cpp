#include "omnimapper/geometry/PolygonUnion.h"

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

constexpr double kUnit = 1e-6;       // [m] Clipper reckons in whole numbers, exactly
constexpr double kFarthest = 1e6;    // [m]
constexpr double kStraight = 0.005;  // [m]

bool isSomewhere(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Eigen::Vector2d& point) {
    return point.allFinite() && point.cwiseAbs().maxCoeff() <= kFarthest;
  });
}

// Empty for one that is nowhere.
Path pathOf(const Points& points) {
  Path path;
  if (!isSomewhere(points)) return path;
  for (const auto& point : points) path.emplace_back(std::llround(point.x() / kUnit), std::llround(point.y() / kUnit));
  return path;
}

Points pointsOf(const Path& path) {
  Points points;
  for (const auto& corner : path)
    points.emplace_back(kUnit * static_cast<double>(corner.X), kUnit * static_cast<double>(corner.Y));
  return points;
}

// Outlines counter-clockwise, holes clockwise.
Paths combined(ClipperLib::ClipType how, const Paths& subject, const Paths& clip) {
  ClipperLib::Clipper clipper(ClipperLib::ioStrictlySimple);
  // False of what has no area; a clipper without any would fail.
  if (!clipper.AddPaths(subject, ClipperLib::ptSubject, true)) return {};
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths result;
  if (!clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero))
    throw base::Error(base::ExitCode::internal, "polygons cannot be united");
  return result;
}

// What the polygon goes around, whichever way.
Paths areasOf(const Points& points) {
  if (!isSomewhere(points)) return {};
  Points corners;
  for (const std::size_t i : keptOfLoop(points, kStraight)) corners.push_back(points[i]);
  return combined(ClipperLib::ctUnion, {pathOf(corners)}, {});
}

// What lay in a hole lies within the outline around it then.
Paths withoutHoles(Paths areas) {
  areas.erase(std::remove_if(areas.begin(), areas.end(), [](const Path& p) { return !ClipperLib::Orientation(p); }),
              areas.end());
  return combined(ClipperLib::ctUnion, areas, {});
}

}  // namespace

std::vector<Points> unionOf(const std::vector<Points>& polygons) {
  Paths all;
  for (const auto& polygon : polygons) {
    Paths areas = areasOf(polygon);
    std::move(areas.begin(), areas.end(), std::back_inserter(all));
  }
  std::vector<Points> outlines;
  for (const auto& area : withoutHoles(combined(ClipperLib::ctUnion, all, {}))) outlines.push_back(pointsOf(area));
  return outlines;
}

double areaOutside(const Points& polygon, const std::vector<Points>& outlines) {
  Paths covered;
  for (const auto& outline : outlines) covered.push_back(pathOf(outline));
  double area = 0;
  for (const auto& left : combined(ClipperLib::ctDifference, areasOf(polygon), covered)) area += ClipperLib::Area(left);
  return kUnit * kUnit * area;
}

}  // namespace omnimapper::geometry
