#pragma once

#include "omnimapper/geometry/Plane3.h"

namespace omnimapper::geometry {

/// The tangent of a plane, in which covariances of planes are given: the change of the normal [rad] along the two
/// columns of tangentBasis(normal), then the change of the distance [m], independent of it.

/// Unit vectors b1, b2 perpendicular to a unit normal n, with b1 x b2 = n: b1 is the coordinate axis along which n has
/// its smallest component (the first of several), made perpendicular to n; b2 = n x b1.
Eigen::Matrix<double, 3, 2> tangentBasis(const Eigen::Vector3d& unit_normal);

/// The plane with normal Exp(b1 x + b2 y) and distance + z, for the change (x, y, z): the normal turns by the length
/// of (x, y) towards b1 x + b2 y.
Plane3 plus(const Plane3& plane, const Eigen::Vector3d& change);

/// The change such that plus(from, change) = to; the length of its first two elements is at most pi.
Eigen::Vector3d minus(const Plane3& to, const Plane3& from);

/// Covariance of a_from_b * plane_in_b to first order, where a_from_b is known exactly.
Eigen::Matrix3d transportCovariance(const Se3& a_from_b, const Plane3& plane_in_b, const Eigen::Matrix3d& cov_in_b);

}  // namespace omnimapper::geometry
