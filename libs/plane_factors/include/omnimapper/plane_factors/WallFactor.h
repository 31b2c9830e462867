#pragma once

#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <Eigen/Core>

namespace omnimapper::plane_factors {

/// A line of a level laser on a wall of a planar map (thesis 4.3.2.4). Variables: map_from_base (se2), wall.
/// Residual: measured minus predicted direction [rad], in (-pi, pi]; then the distance of the line's middle from the
/// wall [m], positive on the free side. Derivation: doc/derivations/wall.md.
class WallFactor : public graph::SizedFactor<2, graph::Se2Kind, WallKind> {
 public:
  /// `direction_in_base` is unit, with the free side on its left.
  WallFactor(const Eigen::Vector2d& direction_in_base, const Eigen::Vector2d& middle_in_base)
      : direction_(direction_in_base), middle_(middle_in_base) {}

  std::string_view kind() const override { return "wall_from_se2"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector2d direction_, middle_;
};

}  // namespace omnimapper::plane_factors
