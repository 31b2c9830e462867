#include <omnimapper/geometry/PlaneTangent.h>

#include <cmath>

namespace omnimapper::geometry {

Eigen::Matrix<double, 3, 2> tangentBasis(const Eigen::Vector3d& unit_normal) {
  int axis = 0;
  unit_normal.cwiseAbs().minCoeff(&axis);
  const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = (along - unit_normal * unit_normal.dot(along)).normalized();
  basis.col(1) = unit_normal.cross(basis.col(0));
  return basis;
}

Plane3 plus(const Plane3& plane, const Eigen::Vector3d& change) {
  const double turn = change.head<2>().norm();
  if (!(turn > 0)) return {plane.normal, plane.distance + change.z()};
  const Eigen::Vector3d towards = tangentBasis(plane.normal) * (change.head<2>() / turn);
  return {(std::cos(turn) * plane.normal + std::sin(turn) * towards).normalized(), plane.distance + change.z()};
}

Eigen::Vector3d minus(const Plane3& to, const Plane3& from) {
  const Eigen::Matrix<double, 3, 2> basis = tangentBasis(from.normal);
  Eigen::Vector2d across = basis.transpose() * to.normal;
  const double sine = across.norm(), cosine = from.normal.dot(to.normal);
  if (sine > 0) {
    across *= std::atan2(sine, cosine) / sine;
  } else if (cosine < 0) {
    across = {kPi, 0};  // opposite normals: all rotations are as short
  }
  return {across.x(), across.y(), to.distance - from.distance};
}

Eigen::Matrix3d transportCovariance(const Se3& a_from_b, const Plane3& plane_in_b, const Eigen::Matrix3d& cov_in_b) {
  const Eigen::Matrix<double, 3, 2> turned = a_from_b.rotation.toRotationMatrix() * tangentBasis(plane_in_b.normal);
  const auto basis_in_a = tangentBasis(a_from_b.rotation * plane_in_b.normal);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() = basis_in_a.transpose() * turned;
  jacobian.bottomLeftCorner<1, 2>() = -a_from_b.translation.transpose() * turned;
  return jacobian * cov_in_b * jacobian.transpose();
}

}  // namespace omnimapper::geometry
