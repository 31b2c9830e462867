#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// A measured direction from a camera to a point. Derivation: doc/derivations/bearing.md.
class MeasuredDirection {
 public:
  /// `camera`: its position [m]. `direction`: a unit vector that is not vertical. Both are in the base.
  MeasuredDirection(const Eigen::Vector3d& camera, const Eigen::Vector3d& direction);

  const Eigen::Vector3d& camera() const { return camera_; }
  const Eigen::Vector3d& direction() const { return direction_; }

  /// The angle from the measured direction to a point [rad], in two components: the first to the left about the
  /// vertical of the base, as a pan turns, the second down, as a tilt turns. `seen`: vector from the camera to the
  /// point, in the axes of the base [m]. The derivative by `seen` is written to `by_seen` if `by_seen` is not null.
  Eigen::Vector2d angleTo(const Eigen::Vector3d& seen, Eigen::Matrix<double, 2, 3>* by_seen) const;

  void write(std::ostream& out) const;
  static MeasuredDirection read(std::istream& in);

 private:
  Eigen::Vector3d camera_, direction_;
  Eigen::Matrix<double, 2, 3> across_;  // unit vectors to the left and down
};

/// The direction in which a camera sees a point of the map. Variables: map_from_base (se3, or se2), point in map
/// (point3). Residual: MeasuredDirection::angleTo() the point [rad].
class SignBearingFactor : public graph::SizedFactor<2, graph::Se3Kind, graph::Point3Kind> {
 public:
  explicit SignBearingFactor(const MeasuredDirection& direction) : direction_(direction) {}

  std::string_view kind() const override { return "sign_bearing"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override { direction_.write(out); }
  static void addTo(graph::FactorRegistry& registry);

 private:
  MeasuredDirection direction_;
};

/// As SignBearingFactor, for a camera on a pan-tilt unit with unknown zero offsets (thesis 4.3.2.5). Variables:
/// map_from_base (se3, or se2), point in map (point3), offsets of the unit (pan_tilt). The axes of the unit pass
/// through the camera.
class PanTiltBearingFactor : public graph::SizedFactor<2, graph::Se3Kind, graph::Point3Kind, graph::PanTiltKind> {
 public:
  /// `tilt_axis`: level unit vector to the left of the panned camera, in the base.
  PanTiltBearingFactor(const MeasuredDirection& direction, const Eigen::Vector3d& tilt_axis)
      : direction_(direction), tilt_axis_(tilt_axis) {}

  std::string_view kind() const override { return "sign_bearing_pan_tilt"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  MeasuredDirection direction_;
  Eigen::Vector3d tilt_axis_;
};

/// The true direction, given the reported one and the offsets of the pan-tilt unit [rad].
Eigen::Vector3d turnedBy(const Eigen::Vector2d& pan_tilt, const Eigen::Vector3d& tilt_axis,
                         const Eigen::Vector3d& direction);

/// The distance of a point from the camera. Variables: map_from_base (se3, or se2), point in map (point3). Residual:
/// the logarithm of predicted over measured distance, so that distances near 0 and infinity both have a large residual.
class SignRangeFactor : public graph::SizedFactor<1, graph::Se3Kind, graph::Point3Kind> {
 public:
  /// `camera`: position in the base [m]. `range`: measured distance [m], positive.
  SignRangeFactor(const Eigen::Vector3d& camera, double range) : camera_(camera), range_(range) {}

  std::string_view kind() const override { return "sign_range"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector3d camera_;
  double range_;
};

}  // namespace omnimapper::plugins
