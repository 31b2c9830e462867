#pragma once

#include "omnimapper/geometry/Plane3.h"

namespace omnimapper::geometry {

/// The tangent of a plane, in which covariances of planes are given: the rotation of the normal [rad] towards each of
/// the two columns of tangentBasis(normal), then the change of the distance [m]. Rotation and distance change
/// independently.

/// Two unit vectors b1 and b2 that are perpendicular to the unit normal n, with b1 x b2 = n. To get b1, the coordinate
/// axis along which n has its smallest component (the first axis, if there are several) is made perpendicular to n; b2
/// = n x b1.
Eigen::Matrix<double, 3, 2> tangentBasis(const Eigen::Vector3d& unit_normal);

/// The changed plane for a change (x, y, z). The normal is rotated by the length of (x, y) [rad] towards b1 x + b2 y,
/// where b1 and b2 are the columns of tangentBasis(); z [m] is added to the distance.
Plane3 plus(const Plane3& plane, const Eigen::Vector3d& change);

/// The change for which plus(from, change) = to. The length of the change's first two elements is at most pi.
Eigen::Vector3d minus(const Plane3& to, const Plane3& from);

/// Covariance of the plane a_from_b * plane_in_b to first order, where a_from_b is known exactly.
Eigen::Matrix3d transportCovariance(const Se3& a_from_b, const Plane3& plane_in_b, const Eigen::Matrix3d& cov_in_b);

}  // namespace omnimapper::geometry
