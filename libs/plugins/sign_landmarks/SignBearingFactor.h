#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// A point of the map that a camera sees in some direction. Variables: map_from_base (se3, or se2), point in map
/// (point3). Residual: the rotation vector from the measured direction to the predicted one, across that [rad]: first
/// to the left about the vertical of the base, as a pan turns, then down, as a tilt does. Derivation:
/// doc/derivations/bearing.md.
class SignBearingFactor : public graph::SizedFactor<2, graph::Se3Kind, graph::Point3Kind> {
 public:
  /// In the base: where the camera is [m], and the direction, a unit vector that is not vertical.
  SignBearingFactor(const Eigen::Vector3d& camera, const Eigen::Vector3d& direction);

  std::string_view kind() const override { return "sign_bearing"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector3d camera_, direction_;
  Eigen::Matrix<double, 2, 3> across_;  // unit vectors to the left and down
};

}  // namespace omnimapper::plugins
