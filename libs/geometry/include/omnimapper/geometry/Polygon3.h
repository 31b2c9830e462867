#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// A closed walk over points of a plane in space [m]; the last one joins the first. May be concave.
struct Polygon3 {
  std::vector<Eigen::Vector3d> vertices;
};

/// Normal to the polygon, as long as its area [m^2]. Seen against it, the vertices go counter-clockwise.
Eigen::Vector3d areaVector(const Polygon3& polygon);

/// [m^2]; that of a walk with fewer than three vertices is 0.
double area(const Polygon3& polygon);

/// Whether the foot of `point` on the polygon's plane lies inside. Even-odd rule, so a walk that crosses itself has
/// insides and outsides too; false for a polygon without area. A point on an edge may count as either.
bool contains(const Polygon3& polygon, const Eigen::Vector3d& point);

}  // namespace omnimapper::geometry
