#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Areas of the plane [m]: outlines counter-clockwise, and holes in them, clockwise. Each hole lies in one outline; an
/// outline may lie in a hole.
struct Areas2 {
  std::vector<std::vector<Eigen::Vector2d>> outlines, holes;
};

/// A polygon with holes in it, each in either sense of rotation [m].
struct HoledPolygon2 {
  std::vector<Eigen::Vector2d> outline;
  std::vector<std::vector<Eigen::Vector2d>> holes;
};

/// The area that polygons of the plane cover together; a hole of one is filled where another covers it. Polygons may be
/// concave; one that crosses itself covers all it goes around; one without area, or with a corner that is not finite or
/// farther than 1000 km from the origin, is ignored. Corners that are not needed to within 5 mm are left out first
/// (keptOfLoop()); then they are rounded to 1 um. Outlines and holes smaller than `least` [m^2] are left out, except
/// the largest outline. Throws Error(internal) if Clipper fails.
Areas2 unionOf(const std::vector<HoledPolygon2>& polygons, double least = 0);

/// The part of a polygon that lies within another one; both are treated as by unionOf().
Areas2 intersectionOf(const HoledPolygon2& polygon, const std::vector<Eigen::Vector2d>& within);

}  // namespace omnimapper::geometry
