#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Variable.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace omnimapper::plane_factors {

/// How a flat surface is optimized: as a plane in space, or, if it is upright, as a line on the floor.
class PlaneParametrization {
 public:
  enum class Kind : std::uint8_t {
    plane = 0,  ///< three degrees of freedom (PlaneVariable)
    wall = 1    ///< two degrees of freedom (WallVariable); only for lines of level lasers in a planar map
  };
  static const PlaneParametrization& of(Kind kind);
  /// The parametrization whose variables are of this kind; null if no parametrization of surfaces has variables of this
  /// kind.
  static const PlaneParametrization* find(const graph::Variable& variable);

  virtual ~PlaneParametrization() = default;
  virtual const std::shared_ptr<const graph::Variable>& variable() const = 0;
  /// The variable's value for a surface that lies on `plane` and has this outline [m], both in the frame of the map.
  virtual Eigen::VectorXd value(const geometry::Plane3& plane, const std::vector<Eigen::Vector3d>& outline) const = 0;
  virtual geometry::Plane3 plane(const Eigen::VectorXd& value) const = 0;
  /// The factor for a line that a laser measured. `direction_in_base` is unit, with the free side on its left.
  virtual std::shared_ptr<const graph::Factor> ofLine(const Eigen::Vector3d& direction_in_base,
                                                      const Eigen::Vector3d& middle_in_base) const = 0;
  /// Whether the surface's tilt is a degree of freedom. Laser lines of one height do not determine the tilt.
  virtual bool mayTilt() const = 0;

  /// The change from `a` to `b`, and its derivatives: by the tangent of `a`, then by the tangent of `b`.
  struct Difference {
    Eigen::VectorXd change;
    Eigen::MatrixXd by_both;
  };
  virtual Difference difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const = 0;
};

/// The change from a landmark's value `a` to its value `b`. It is computed by the parametrization if the variable is
/// that of a surface. Otherwise it is computed by the variable's minus(), as if all values had the same tangent space.
PlaneParametrization::Difference differenceOf(const graph::Variable& variable, const Eigen::VectorXd& a,
                                              const Eigen::VectorXd& b);

}  // namespace omnimapper::plane_factors
