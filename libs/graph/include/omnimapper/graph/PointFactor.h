#pragma once

#include <Eigen/Core>
#include <memory>

#include "omnimapper/graph/SizedFactor.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

/// A point of the map, measured from a pose. Variables: map_from_base, point_in_map.
/// Residual: inverse(map_from_base) * point_in_map - point_in_base measured, in the axes of the base [m].
/// Derivation: doc/derivations/point.md.
class PointFactor2 : public SizedFactor<2, Se2Kind, Point2Kind> {
 public:
  explicit PointFactor2(const Eigen::Vector2d& point_in_base) : point_in_base_(point_in_base) {}
  const Eigen::Vector2d& measured() const { return point_in_base_; }

  std::string_view kind() const override { return "point2_from_se2"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  Eigen::Vector2d point_in_base_;
};

class PointFactor3 : public SizedFactor<3, Se3Kind, Point3Kind> {
 public:
  explicit PointFactor3(const Eigen::Vector3d& point_in_base) : point_in_base_(point_in_base) {}
  const Eigen::Vector3d& measured() const { return point_in_base_; }

  std::string_view kind() const override { return "point3_from_se3"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  Eigen::Vector3d point_in_base_;
};

/// States that two points of the map are the same point. Variables: point, point. Residual: second - first [m].
class SamePointFactor : public SizedFactor<3, Point3Kind, Point3Kind> {
 public:
  static constexpr std::string_view kKind = "same_point3";
  /// `odds`: prior odds that both points are the same.
  explicit SamePointFactor(double odds = 1) : odds_(odds) {}
  double odds() const { return odds_; }

  std::string_view kind() const override { return kKind; }
  /// Any difference of two points of the map, times the odds.
  std::optional<double> outlierVolume(const Eigen::Vector3d& map_size) const override;
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  static std::shared_ptr<SamePointFactor> read(std::istream& in);

 private:
  double odds_;
};

}  // namespace omnimapper::graph
