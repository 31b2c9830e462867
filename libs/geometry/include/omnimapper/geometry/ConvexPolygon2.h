#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// The corners of the smallest convex polygon around points of the plane [m], counter-clockwise; points on its edges
/// are none. Two corners if all points are on a line, one if they are one point, none if there are none.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// [m^2]; 0 for fewer than three corners. Counter-clockwise polygons have a positive area.
double area(const std::vector<Eigen::Vector2d>& polygon);

/// The least distance between two convex polygons (or segments, or points) [m]; 0 where they meet. Neither is empty.
double distance(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b);

}  // namespace omnimapper::geometry
