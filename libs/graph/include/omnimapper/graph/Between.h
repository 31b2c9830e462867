#pragma once

#include <omnimapper/geometry/Se3.h>

#include "omnimapper/graph/SizedFactor.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

/// A measured motion from pose a to pose b. Variables: map_from_a, map_from_b. Residual: minus(inverse(map_from_a) *
/// map_from_b, a_from_b measured), that is, translation [m] and then yaw or rotation vector [rad], in the axes of the
/// measured frame b. Noise: covariance of a_from_b in the tangent of Se2 or Se3. Derivation:
/// doc/derivations/between.md.
class BetweenSe2 : public SizedFactor<3, Se2Kind, Se2Kind> {
 public:
  explicit BetweenSe2(const geometry::Se2& a_from_b);
  const geometry::Se2& measured() const { return a_from_b_; }

  std::string_view kind() const override { return "between_se2"; }
  /// Any position in the map's plane, any heading.
  std::optional<double> outlierVolume(const Eigen::Vector3d& map_size) const override;
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  geometry::Se2 a_from_b_;
  double cosine_, sine_;  // cosine and sine of the measured yaw
};

class BetweenSe3 : public SizedFactor<6, Se3Kind, Se3Kind> {
 public:
  explicit BetweenSe3(const geometry::Se3& a_from_b) : a_from_b_(a_from_b) {}
  const geometry::Se3& measured() const { return a_from_b_; }

  std::string_view kind() const override { return "between_se3"; }
  /// Any position in the map, any rotation (in rotation vectors).
  std::optional<double> outlierVolume(const Eigen::Vector3d& map_size) const override;
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  geometry::Se3 a_from_b_;
};

}  // namespace omnimapper::graph
