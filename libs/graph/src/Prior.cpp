#include "omnimapper/graph/Prior.h"

#include "PoseIo.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

const std::vector<std::string_view>& PriorSe2::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se2"};
  return kinds;
}

void PriorSe2::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se2 map_from_a = se2FromValue(values[0]);
  Eigen::Map<Eigen::Vector3d>{residual} = geometry::minus(map_from_a, map_from_a_);
  if (!jacobians || !jacobians[0]) return;
  const double c = std::cos(map_from_a.yaw - map_from_a_.yaw), s = std::sin(map_from_a.yaw - map_from_a_.yaw);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{jacobians[0]} << c, -s, 0, s, c, 0, 0, 0, 1;
}

void PriorSe2::write(std::ostream& out) const {
  writePose(out, map_from_a_);
}

const std::vector<std::string_view>& PriorSe3::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se3"};
  return kinds;
}

void PriorSe3::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_a = se3FromValue(values[0]);
  const geometry::Vector6d r = geometry::minus(map_from_a, map_from_a_);
  Eigen::Map<geometry::Vector6d>{residual} = r;
  if (!jacobians || !jacobians[0]) return;
  const Eigen::Matrix3d turn = (map_from_a_.rotation.conjugate() * map_from_a.rotation).toRotationMatrix();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>{jacobians[0]} << turn, Eigen::Matrix3d::Zero(),
      Eigen::Matrix3d::Zero(), geometry::inverseRightJacobianSo3(r.tail<3>());
}

void PriorSe3::write(std::ostream& out) const {
  writePose(out, map_from_a_);
}

}  // namespace omnimapper::graph
