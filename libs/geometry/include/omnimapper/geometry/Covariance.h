#pragma once

#include "omnimapper/geometry/Se3.h"

namespace omnimapper::geometry {

/// Propagation of covariances of poses, in the tangent of Se2 (3x3) and Se3 (6x6), to first order.

/// Covariance of a_from_b * b_from_c, computed from the covariances of a_from_b and b_from_c, which must be
/// independent. The value of a_from_b is not needed.
Eigen::Matrix3d composeCovariance(const Eigen::Matrix3d& cov_a_from_b, const Se2& b_from_c,
                                  const Eigen::Matrix3d& cov_b_from_c);
Matrix6d composeCovariance(const Matrix6d& cov_a_from_b, const Se3& b_from_c, const Matrix6d& cov_b_from_c);

/// Covariance of inverse(a_from_b).
Eigen::Matrix3d inverseCovariance(const Se2& a_from_b, const Eigen::Matrix3d& cov_a_from_b);
Matrix6d inverseCovariance(const Se3& a_from_b, const Matrix6d& cov_a_from_b);

/// Covariance of a_from_b = inverse(map_from_a) * map_from_b, computed from the joint covariance of map_from_a and
/// map_from_b, in this order (6x6 for Se2, 12x12 for Se3).
Eigen::Matrix3d betweenCovariance(const Se2& a_from_b, const Eigen::Matrix<double, 6, 6>& joint_cov);
Matrix6d betweenCovariance(const Se3& a_from_b, const Eigen::Matrix<double, 12, 12>& joint_cov);

/// A planar covariance (x y yaw) as a covariance of Se3, with zeros outside x, y and yaw.
Matrix6d embedPlanar(const Eigen::Matrix3d& planar_cov);
/// The rows and columns x, y and yaw of a covariance of Se3: the covariance of the planar part.
Eigen::Matrix3d planarPart(const Matrix6d& cov);

}  // namespace omnimapper::geometry
