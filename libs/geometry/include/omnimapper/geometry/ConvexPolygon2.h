#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// The corners of the convex hull of points in the plane [m], counter-clockwise, without points on the hull's edges.
/// Two corners if all points are on a line, one if they coincide, none if there are no points.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// Area [m^2], positive for counter-clockwise polygons; 0 for fewer than three corners.
double area(const std::vector<Eigen::Vector2d>& polygon);

/// Smallest distance between two convex polygons [m], which may also be segments or points; 0 where they meet. Neither
/// may be empty. Corners are counter-clockwise.
double distance(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b);

}  // namespace omnimapper::geometry
