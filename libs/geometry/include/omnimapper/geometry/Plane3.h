#pragma once

#include "omnimapper/geometry/Se3.h"

namespace omnimapper::geometry {

/// A plane in Hessian form: the points p with normal . p + distance = 0. The normal is a unit vector and points to the
/// side of free space, where the sensor is. So in the frame of the sensor that sees the plane, distance >= 0 [m].
struct Plane3 {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double distance = 0;  ///< [m]

  /// The plane through a point.
  static Plane3 through(const Eigen::Vector3d& point, const Eigen::Vector3d& unit_normal) {
    return {unit_normal, -unit_normal.dot(point)};
  }
};

/// Distance of a point from the plane [m], positive on the normal's side.
inline double signedDistance(const Plane3& plane, const Eigen::Vector3d& point) {
  return plane.normal.dot(point) + plane.distance;
}

/// The same plane in frame a: for a point p of frame b, the result has at a_from_b * p the signed distance that
/// `plane_in_b` has at p.
inline Plane3 operator*(const Se3& a_from_b, const Plane3& plane_in_b) {
  const Eigen::Vector3d normal = a_from_b.rotation * plane_in_b.normal;
  return {normal, plane_in_b.distance - normal.dot(a_from_b.translation)};
}

}  // namespace omnimapper::geometry
