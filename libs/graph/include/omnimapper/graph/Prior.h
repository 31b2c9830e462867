#pragma once

#include <omnimapper/geometry/Se3.h>

#include "omnimapper/graph/SizedFactor.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

/// A pose that is known beforehand. Variable: map_from_a. Residual: minus(map_from_a, map_from_a measured), that is,
/// translation [m] in the axes of the measured frame a, then yaw or rotation vector [rad]. Noise: covariance of the
/// measured pose in the tangent of Se2 or Se3. Derivation: doc/derivations/prior.md.
class PriorSe2 : public SizedFactor<3, Se2Kind> {
 public:
  explicit PriorSe2(const geometry::Se2& map_from_a) : map_from_a_(map_from_a) {}
  const geometry::Se2& measured() const { return map_from_a_; }

  std::string_view kind() const override { return "prior_se2"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  geometry::Se2 map_from_a_;
};

class PriorSe3 : public SizedFactor<6, Se3Kind> {
 public:
  explicit PriorSe3(const geometry::Se3& map_from_a) : map_from_a_(map_from_a) {}
  const geometry::Se3& measured() const { return map_from_a_; }

  std::string_view kind() const override { return "prior_se3"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  geometry::Se3 map_from_a_;
};

/// Two angles of a pan-tilt unit that are known beforehand. Variable: pan_tilt. Residual: the angles minus the
/// measured ones [rad].
class PriorPanTilt : public SizedFactor<2, PanTiltKind> {
 public:
  explicit PriorPanTilt(const Eigen::Vector2d& angles) : angles_(angles) {}

  std::string_view kind() const override { return "prior_pan_tilt"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  Eigen::Vector2d angles_;
};

}  // namespace omnimapper::graph
