#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Outlines of what polygons of the plane cover together [m], each counter-clockwise; holes are closed. The polygons
/// may be concave and go either way; one that crosses itself counts as its convex hull, one without area as nothing.
/// None of the points may be infinite or NaN. Corners of theirs that lie within 5 mm of the line between their
/// neighbours are left out first.
std::vector<std::vector<Eigen::Vector2d>> unionOf(const std::vector<std::vector<Eigen::Vector2d>>& polygons);

/// How much of a polygon lies outside all of `outlines`, which unionOf() gave [m^2].
double areaOutside(const std::vector<Eigen::Vector2d>& polygon,
                   const std::vector<std::vector<Eigen::Vector2d>>& outlines);

}  // namespace omnimapper::geometry
