#include "omnimapper/graph/Prior.h"

#include "omnimapper/graph/ByteIo.h"

namespace omnimapper::graph {

void PriorSe2::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se2 map_from_a = se2FromValue(values[0]);
  Eigen::Map<Eigen::Vector3d>{residual} = geometry::minus(map_from_a, map_from_a_);
  auto by_a = jacobian<0>(jacobians);
  if (!by_a) return;
  const double c = std::cos(map_from_a.yaw - map_from_a_.yaw), s = std::sin(map_from_a.yaw - map_from_a_.yaw);
  by_a << c, -s, 0, s, c, 0, 0, 0, 1;
}

void PriorSe2::write(std::ostream& out) const {
  writeVector(out, toValue(map_from_a_));
}

void PriorSe3::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_a = se3FromValue(values[0]);
  const geometry::Vector6d r = geometry::minus(map_from_a, map_from_a_);
  Eigen::Map<geometry::Vector6d>{residual} = r;
  auto by_a = jacobian<0>(jacobians);
  if (!by_a) return;
  const Eigen::Matrix3d turn = (map_from_a_.rotation.conjugate() * map_from_a.rotation).toRotationMatrix();
  by_a << turn, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), geometry::inverseRightJacobianSo3(r.tail<3>());
}

void PriorSe3::write(std::ostream& out) const {
  writeVector(out, toValue(map_from_a_));
}

void PriorPanTilt::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  Eigen::Map<Eigen::Vector2d>{residual} = Eigen::Map<const Eigen::Vector2d>(values[0]) - angles_;
  if (auto by_angles = jacobian<0>(jacobians)) by_angles.setIdentity();
}

void PriorPanTilt::write(std::ostream& out) const {
  writeVector(out, angles_);
}

}  // namespace omnimapper::graph
