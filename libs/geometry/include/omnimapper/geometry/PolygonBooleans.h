#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Areas of the plane [m]: outlines are counter-clockwise, holes in them are clockwise. Each hole lies in one outline;
/// an outline may lie in a hole.
struct Areas2 {
  std::vector<std::vector<Eigen::Vector2d>> outlines, holes;
};

/// A polygon with holes [m]. The corners of the outline and of each hole may be in either order of rotation.
struct HoledPolygon2 {
  std::vector<Eigen::Vector2d> outline;
  std::vector<std::vector<Eigen::Vector2d>> holes;
};

/// The area that polygons of the plane cover together; a hole of one polygon is filled where another polygon covers it.
/// Polygons may be concave. A polygon that crosses itself covers everything that it goes around. A polygon is ignored
/// if it has no area, or if a coordinate of a corner is not finite or beyond 1000 km. First, corners are left out
/// without which the polygon changes by less than 5 mm (keptOfLoop()); then the others are rounded to 1 um. Outlines
/// and holes of the result that are smaller than `least` [m^2] are left out, except the largest outline. Throws
/// Error(internal) if Clipper fails.
Areas2 unionOf(const std::vector<HoledPolygon2>& polygons, double least = 0);

/// The part of `polygon` that lies within the polygon `within`; both are treated as by unionOf().
Areas2 intersectionOf(const HoledPolygon2& polygon, const std::vector<Eigen::Vector2d>& within);

}  // namespace omnimapper::geometry
