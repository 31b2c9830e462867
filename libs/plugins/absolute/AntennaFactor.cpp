#include "AntennaFactor.h"

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>

namespace omnimapper::plugins {

const std::vector<std::string_view>& AntennaFactor::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se3", "se3"};
  return kinds;
}

void AntennaFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_enu = graph::se3FromValue(values[0]);
  const geometry::Se3 map_from_base = graph::se3FromValue(values[1]);
  const Eigen::Matrix3d enu_from_map = map_from_enu.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d predicted = enu_from_map * (map_from_base * antenna_in_base_ - map_from_enu.translation);
  const int rows = residualSize();
  Eigen::Map<Eigen::VectorXd>(residual, rows) = (predicted - antenna_in_enu_).head(rows);
  if (!jacobians) return;
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  using RowMajor = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>>;
  if (jacobians[0]) {
    Jacobian by_enu;
    by_enu << -Eigen::Matrix3d::Identity(), geometry::skew(predicted);
    RowMajor(jacobians[0], rows, 6) = by_enu.topRows(rows);
  }
  if (jacobians[1]) {
    const Eigen::Matrix3d enu_from_base = enu_from_map * map_from_base.rotation.toRotationMatrix();
    Jacobian by_base;
    by_base << enu_from_base, -enu_from_base * geometry::skew(antenna_in_base_);
    RowMajor(jacobians[1], rows, 6) = by_base.topRows(rows);
  }
}

void AntennaFactor::write(std::ostream& out) const {
  graph::writeVector(out, antenna_in_base_);
  graph::writeVector(out, antenna_in_enu_);
  graph::writeUint(out, up_, 1);
}

void AntennaFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("antenna", [](std::istream& in) {
    const Eigen::Vector3d antenna_in_base = graph::readVector<3>(in), antenna_in_enu = graph::readVector<3>(in);
    const bool up = graph::readUint(in, 1) != 0;
    return std::make_shared<AntennaFactor>(antenna_in_base, antenna_in_enu, up);
  });
}

}  // namespace omnimapper::plugins
