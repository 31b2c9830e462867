#include "omnimapper/geometry/Covariance.h"

namespace omnimapper::geometry {

namespace {

constexpr int kPlanar[3] = {0, 1, 5};

template <class Matrix, class Pose>
Matrix compose(const Matrix& cov_a_from_b, const Pose& b_from_c, const Matrix& cov_b_from_c) {
  const Matrix transport = adjoint(inverse(b_from_c));
  return transport * cov_a_from_b * transport.transpose() + cov_b_from_c;
}

template <class Matrix, class Pose>
Matrix invert(const Pose& a_from_b, const Matrix& cov_a_from_b) {
  const Matrix transport = adjoint(a_from_b);
  return transport * cov_a_from_b * transport.transpose();
}

/// The tangent of a_from_b moves by d_b - Ad(b_from_a) d_a.
template <class Matrix, class Pose, class Joint>
Matrix between(const Pose& a_from_b, const Joint& joint_cov) {
  constexpr int n = Matrix::RowsAtCompileTime;
  Eigen::Matrix<double, n, 2 * n> jacobian;
  jacobian << -adjoint(inverse(a_from_b)), Matrix::Identity();
  return jacobian * joint_cov * jacobian.transpose();
}

}  // namespace

Eigen::Matrix3d composeCovariance(const Eigen::Matrix3d& cov_a_from_b, const Se2& b_from_c,
                                  const Eigen::Matrix3d& cov_b_from_c) {
  return compose(cov_a_from_b, b_from_c, cov_b_from_c);
}

Matrix6d composeCovariance(const Matrix6d& cov_a_from_b, const Se3& b_from_c, const Matrix6d& cov_b_from_c) {
  return compose(cov_a_from_b, b_from_c, cov_b_from_c);
}

Eigen::Matrix3d inverseCovariance(const Se2& a_from_b, const Eigen::Matrix3d& cov_a_from_b) {
  return invert(a_from_b, cov_a_from_b);
}

Matrix6d inverseCovariance(const Se3& a_from_b, const Matrix6d& cov_a_from_b) {
  return invert(a_from_b, cov_a_from_b);
}

Eigen::Matrix3d betweenCovariance(const Se2& a_from_b, const Eigen::Matrix<double, 6, 6>& joint_cov) {
  return between<Eigen::Matrix3d>(a_from_b, joint_cov);
}

Matrix6d betweenCovariance(const Se3& a_from_b, const Eigen::Matrix<double, 12, 12>& joint_cov) {
  return between<Matrix6d>(a_from_b, joint_cov);
}

Matrix6d embedPlanar(const Eigen::Matrix3d& planar_cov) {
  Matrix6d cov = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) cov(kPlanar[i], kPlanar[j]) = planar_cov(i, j);
  return cov;
}

Eigen::Matrix3d planarPart(const Matrix6d& cov) {
  Eigen::Matrix3d planar_cov;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) planar_cov(i, j) = cov(kPlanar[i], kPlanar[j]);
  return planar_cov;
}

}  // namespace omnimapper::geometry
