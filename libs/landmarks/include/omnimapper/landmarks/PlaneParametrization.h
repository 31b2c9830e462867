#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Variable.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace omnimapper::landmarks {

/// What is optimised of a flat surface: where its plane is in space, or where an upright one is on the floor.
class PlaneParametrization {
 public:
  enum class Kind : std::uint8_t {
    plane = 0,  ///< three degrees of freedom (PlaneVariable)
    wall = 1    ///< two (WallVariable); lines of level lasers in a planar map alone
  };
  static const PlaneParametrization& of(Kind kind);
  /// Whose values are of this kind; null if they are of no surface.
  static const PlaneParametrization* find(const graph::Variable& variable);

  virtual ~PlaneParametrization() = default;
  virtual const std::shared_ptr<const graph::Variable>& variable() const = 0;
  /// Of a surface on that plane, with that outline [m]; the frame is the map's.
  virtual Eigen::VectorXd value(const geometry::Plane3& plane, const std::vector<Eigen::Vector3d>& outline) const = 0;
  virtual geometry::Plane3 plane(const Eigen::VectorXd& value) const = 0;
  /// Of a laser's line: `direction_in_base` is unit, the free side on its left.
  virtual std::shared_ptr<const graph::Factor> ofLine(const Eigen::Vector3d& direction_in_base,
                                                      const Eigen::Vector3d& middle_in_base) const = 0;
  /// Whether the tilt is a degree of freedom; lines of one height do not show it.
  virtual bool mayTilt() const = 0;

  /// The change that takes `a` to `b`, and how it changes with both: the tangent of `a`, then that of `b`.
  struct Difference {
    Eigen::VectorXd change;
    Eigen::MatrixXd by_both;
  };
  virtual Difference difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const = 0;
};

/// The change that takes a landmark's value `a` to `b`: of a surface its form's, of anything else that of its kind, as
/// if all its values had one tangent.
PlaneParametrization::Difference differenceOf(const graph::Variable& variable, const Eigen::VectorXd& a,
                                              const Eigen::VectorXd& b);

}  // namespace omnimapper::landmarks
