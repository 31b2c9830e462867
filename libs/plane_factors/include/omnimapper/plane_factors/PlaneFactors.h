#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneVariable.h>

#include <Eigen/Core>

namespace omnimapper::plane_factors {

/// Measurements of a plane of the map. Derivations: doc/derivations/plane.md and line_on_plane.md.

/// A plane measured as a plane (thesis 4.2.2.3, but with three residuals: one of the thesis's four is redundant).
/// Variables: map_from_base, plane in map. Residual: minus(plane predicted in the base, plane measured in the base),
/// defined in geometry/PlaneTangent.h: two rotations of the normal [rad], then the difference of the distances [m].
class PlaneFactor : public graph::SizedFactor<3, graph::Se3Kind, PlaneKind> {
 public:
  explicit PlaneFactor(const geometry::Plane3& plane_in_base) : measured_(plane_in_base) {}

  std::string_view kind() const override { return "plane_from_se3"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  geometry::Plane3 measured_;
};

/// A straight line of a laser scan that lies on a plane (thesis 4.2.3). The line does not determine the rotation of the
/// plane about the line.
/// Variables: map_from_base, plane in map. Residual: the sine of the angle between line and plane (n . b, where n is
/// the plane's normal and b the line's direction), then the distance of the line's middle from the plane [m], positive
/// on the side of n.
class LineOnPlaneFactor : public graph::SizedFactor<2, graph::Se3Kind, PlaneKind> {
 public:
  /// `direction_in_base` is unit.
  LineOnPlaneFactor(const Eigen::Vector3d& direction_in_base, const Eigen::Vector3d& middle_in_base)
      : direction_(direction_in_base), middle_(middle_in_base) {}

  std::string_view kind() const override { return "line_on_plane"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector3d direction_, middle_;
};

/// Keeps a plane upright as long as only laser lines of one height have measured it. Variable: plane in map. Residual:
/// the tangent of the plane's tilt from upright, at most 100. The sine, which is at most 1, would be too weak: a few
/// wrong lines could tilt the plane until it is level, and then every line of a level laser fits the plane.
class UprightFactor : public graph::SizedFactor<1, PlaneKind> {
 public:
  static constexpr std::string_view kKind = "upright_plane";

  std::string_view kind() const override { return kKind; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);
};

}  // namespace omnimapper::plane_factors
