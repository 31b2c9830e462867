#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// Outlines of what polygons of the plane cover together [m], each counter-clockwise; holes are closed. The polygons
/// may be concave and go either way; one that crosses itself counts as all it goes around; one without area, or with a
/// corner that is not finite or farther than 1000 km from the origin, as nothing. Corners of theirs that are not needed
/// to within 5 mm are left out first (keptOfLoop()); then they are rounded to 1 um. Throws Error(internal) if Clipper
/// fails.
std::vector<std::vector<Eigen::Vector2d>> unionOf(const std::vector<std::vector<Eigen::Vector2d>>& polygons);

/// How much of a polygon lies outside all of `outlines`, which unionOf() gave [m^2].
double areaOutside(const std::vector<Eigen::Vector2d>& polygon,
                   const std::vector<std::vector<Eigen::Vector2d>>& outlines);

}  // namespace omnimapper::geometry
