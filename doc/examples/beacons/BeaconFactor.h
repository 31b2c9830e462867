#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/FactorRegistry.h>

#include <Eigen/Core>

namespace beacons {

// Step 2: the measurement, as a residual of the variables with its derivatives. The graph whitens the residual, applies
// the loss, and lifts the pose of a planar map into space; the factor does none of that.

/// A beacon seen from a pose: range [m], yaw and pitch [rad] in the sensor, with MRPT's signs (pitch positive
/// downwards). Variables: map_from_base (se3), then reported_from_sensor (se3) if the pose of the sensor is estimated,
/// then the beacon. Residual: predicted - measured, the angles in (-pi, pi].
///
/// With p_b = inverse(map_from_base) * beacon and p = inverse(base_from_reported * reported_from_sensor) * p_b
///   range = |p|,  yaw = atan2(p.y, p.x),  pitch = atan2(-p.z, rho),  rho = sqrt(p.x^2 + p.y^2),
/// whose derivative by p is, one row each,
///   p^T / range,  (-p.y, p.x, 0) / rho^2,  (p.x p.z / rho, p.y p.z / rho, -rho) / range^2.
/// A pose perturbed on the right, (p + R t, R Exp(w)), moves a point q in its frame by -t + [q]x w. So p changes by
///   base_from_sensor's R^T (-t + [p_b]x w)  with map_from_base,
///   -t + [p]x w                             with reported_from_sensor,
///   map_from_sensor's R^T, columns x and y  with the beacon, whose tangent is the plane of its height.
class BeaconFactor : public omnimapper::graph::Factor {
 public:
  /// `estimated`: whether reported_from_sensor is a variable; else it is the identity.
  BeaconFactor(const Eigen::Vector3d& range_yaw_pitch, const omnimapper::geometry::Se3& base_from_reported,
               bool estimated)
      : measured_(range_yaw_pitch), base_from_reported_(base_from_reported), estimated_(estimated) {}

  std::string_view kind() const override { return "beacon_measurement"; }
  int residualSize() const override { return 3; }
  const std::vector<std::string_view>& variableKinds() const override;
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  /// Registers the reader of what write() wrote.
  static void addTo(omnimapper::graph::FactorRegistry& registry);

 private:
  Eigen::Vector3d measured_;
  omnimapper::geometry::Se3 base_from_reported_;
  bool estimated_;
};

}  // namespace beacons
