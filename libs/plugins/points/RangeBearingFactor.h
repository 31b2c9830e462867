#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// Factors for a point of the map that a range-bearing sensor measured. Derivation: doc/derivations/range_bearing.md.

/// For a planar map (thesis 4.6.2.1, equation 10). Variables: map_from_base (se2), point in map (point2). Residual:
/// horizontal range [m], bearing [rad, in (-pi, pi]], each predicted - measured.
class RangeBearingFactor2 : public graph::SizedFactor<2, graph::Se2Kind, graph::Point2Kind> {
 public:
  /// `sensor_in_base`: position on the floor [m]. `range`: horizontal [m]. `bearing`: horizontal angle of the point at
  /// the sensor, from the direction of the base's x axis [rad].
  RangeBearingFactor2(const Eigen::Vector2d& sensor_in_base, double range, double bearing)
      : sensor_in_base_(sensor_in_base), range_(range), bearing_(bearing) {}

  std::string_view kind() const override { return "range_bearing2"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector2d sensor_in_base_;
  double range_, bearing_;
};

/// For a spatial map. Variables: map_from_base (se3), point in map (point3). Residual: range [m], yaw and pitch [rad],
/// each predicted - measured. The angles are in (-pi, pi] and have MRPT's sense: yaw to the left, pitch down.
class RangeBearingFactor3 : public graph::SizedFactor<3, graph::Se3Kind, graph::Point3Kind> {
 public:
  RangeBearingFactor3(const geometry::Se3& base_from_sensor, const Eigen::Vector3d& range_yaw_pitch)
      : base_from_sensor_(base_from_sensor), measured_(range_yaw_pitch) {}

  std::string_view kind() const override { return "range_bearing3"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  geometry::Se3 base_from_sensor_;
  Eigen::Vector3d measured_;
};

}  // namespace omnimapper::plugins
