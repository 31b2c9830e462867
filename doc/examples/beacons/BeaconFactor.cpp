#include "BeaconFactor.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <cmath>

namespace beacons {

using omnimapper::geometry::Se3;
using omnimapper::geometry::skew;
using omnimapper::geometry::wrapToPi;
namespace graph = omnimapper::graph;

const std::vector<std::string_view>& BeaconFactor::variableKinds() const {
  static const std::vector<std::string_view> reported = {"se3", "beacon"}, estimated = {"se3", "se3", "beacon"};
  return estimated_ ? estimated : reported;
}

void BeaconFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Se3 map_from_base = graph::se3FromValue(values[0]);
  const Se3 base_from_sensor = estimated_ ? base_from_reported_ * graph::se3FromValue(values[1]) : base_from_reported_;
  const int last = estimated_ ? 2 : 1;
  const Eigen::Vector3d beacon_in_map = Eigen::Map<const Eigen::Vector3d>(values[last]);
  const Eigen::Vector3d p_b = inverse(map_from_base) * beacon_in_map;
  const Eigen::Vector3d p = inverse(base_from_sensor) * p_b;
  // Straight above the sensor the yaw is undefined: the bounds keep numbers finite there, and change nothing elsewhere.
  const double rho = std::max(p.head<2>().norm(), 1e-9), range = std::max(p.norm(), 1e-9);
  Eigen::Map<Eigen::Vector3d> r(residual);
  r << range - measured_[0], wrapToPi(std::atan2(p.y(), p.x()) - measured_[1]),
      wrapToPi(std::atan2(-p.z(), rho) - measured_[2]);
  if (!jacobians) return;

  Eigen::Matrix3d by_p;
  by_p.row(0) = p / range;
  by_p.row(1) = Eigen::Vector3d(-p.y(), p.x(), 0) / (rho * rho);
  by_p.row(2) = Eigen::Vector3d(p.x() * p.z() / rho, p.y() * p.z() / rho, -rho) / (range * range);
  const Eigen::Matrix3d sensor_from_base = base_from_sensor.rotation.conjugate().toRotationMatrix();
  // A null pointer means that this Jacobian is not needed, because the variable is fixed.
  using ByPose = Eigen::Map<Eigen::Matrix<double, 3, 6, Eigen::RowMajor>>;
  if (jacobians[0]) {
    ByPose by_base(jacobians[0]);
    by_base.leftCols<3>() = -by_p * sensor_from_base;
    by_base.rightCols<3>() = by_p * sensor_from_base * skew(p_b);
  }
  if (estimated_ && jacobians[1]) {
    ByPose by_correction(jacobians[1]);
    by_correction.leftCols<3>() = -by_p;
    by_correction.rightCols<3>() = by_p * skew(p);
  }
  if (jacobians[last]) {
    const Eigen::Matrix3d base_from_map = map_from_base.rotation.conjugate().toRotationMatrix();
    Eigen::Map<Eigen::Matrix<double, 3, 2, Eigen::RowMajor>> by_beacon(jacobians[last]);
    by_beacon = (by_p * sensor_from_base * base_from_map).leftCols<2>();
  }
}

void BeaconFactor::write(std::ostream& out) const {
  for (const double number : measured_) graph::writeDouble(out, number);
  for (const double number : graph::toValue(base_from_reported_)) graph::writeDouble(out, number);
  graph::writeUint(out, estimated_, 1);
}

void BeaconFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("beacon_measurement", [](std::istream& in) {
    Eigen::Vector3d measured;
    Eigen::Matrix<double, 7, 1> pose;
    for (double& number : measured) number = graph::readDouble(in);
    for (double& number : pose) number = graph::readDouble(in);
    const bool estimated = graph::readUint(in, 1) != 0;
    return std::make_shared<BeaconFactor>(measured, graph::se3FromValue(pose.data()), estimated);
  });
}

}  // namespace beacons
