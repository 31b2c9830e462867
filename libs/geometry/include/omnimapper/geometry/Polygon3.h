#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::geometry {

/// A closed polygon in a plane in space [m]; the last vertex is joined to the first. May be concave.
struct Polygon3 {
  std::vector<Eigen::Vector3d> vertices;
};

/// Normal of the polygon, whose length is the polygon's area [m^2]. Seen from the side to which the normal points, the
/// vertices go counter-clockwise.
Eigen::Vector3d areaVector(const Polygon3& polygon);

/// Area [m^2]; 0 for fewer than three vertices.
double area(const Polygon3& polygon);

/// Whether the projection of `point` onto the polygon's plane lies inside the polygon. The even-odd rule decides, also
/// for a polygon that crosses itself. False for a polygon without area. A point on an edge may count as inside or
/// outside.
bool contains(const Polygon3& polygon, const Eigen::Vector3d& point);

}  // namespace omnimapper::geometry
