#pragma once

#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/graph/SizedFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// Virtual measurements (thesis 4.5): factors that state a regularity of buildings about two landmarks. Derivations:
/// doc/derivations/relations.md.

/// A point lies on a wall. Variables: point2, wall. Residual: the distance of the point from the wall [m], positive on
/// the free side.
class PointOnWallFactor : public graph::SizedFactor<1, graph::Point2Kind, plane_factors::WallKind> {
 public:
  std::string_view kind() const override { return "point_on_wall"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// A point in space lies above or below the line of a wall on the floor. Variables: point3, wall. Residual: as that of
/// PointOnWallFactor.
class Point3OnWallFactor : public graph::SizedFactor<1, graph::Point3Kind, plane_factors::WallKind> {
 public:
  std::string_view kind() const override { return "point3_on_wall"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// A point lies on a plane. Variables: point3, plane. Residual: the distance of the point from the plane [m], positive
/// on the free side.
class PointOnPlaneFactor : public graph::SizedFactor<1, graph::Point3Kind, plane_factors::PlaneKind> {
 public:
  std::string_view kind() const override { return "point_on_plane"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// Two walls at a multiple of a right angle. Variables: wall a, wall b. Residual: b's direction - a's direction - the
/// number of quarter turns * pi / 2 [rad], in (-pi, pi].
class WallTurnFactor : public graph::SizedFactor<1, plane_factors::WallKind, plane_factors::WallKind> {
 public:
  explicit WallTurnFactor(int quarters) : quarters_(quarters & 3) {}

  std::string_view kind() const override { return "wall_turn"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  int quarters_;
};

/// Two walls on one line, with the same free side. Variables: wall a, wall b. Residual: b's direction - a's direction
/// [rad], then the signed distance of b's middle from a [m].
class WallsAlignedFactor : public graph::SizedFactor<2, plane_factors::WallKind, plane_factors::WallKind> {
 public:
  std::string_view kind() const override { return "walls_aligned"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// The second row of WallsAlignedFactor, for two walls whose angle is determined by other relations. Variables: wall a,
/// wall b. Residual: the signed distance of b's middle from a [m].
class WallShiftFactor : public graph::SizedFactor<1, plane_factors::WallKind, plane_factors::WallKind> {
 public:
  std::string_view kind() const override { return "wall_shift"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// Two parallel planes, with normals in the same or in opposite directions. Variables: plane a, plane b. Residual: the
/// components of b's normal that are perpendicular to a's normal, along the axes of geometry::tangentBasis() of a's
/// normal [rad to first order].
class PlanesParallelFactor : public graph::SizedFactor<2, plane_factors::PlaneKind, plane_factors::PlaneKind> {
 public:
  std::string_view kind() const override { return "planes_parallel"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// Two planes at a right angle. Variables: plane a, plane b. Residual: the dot product of the normals [rad to first
/// order].
class PlanesSquareFactor : public graph::SizedFactor<1, plane_factors::PlaneKind, plane_factors::PlaneKind> {
 public:
  std::string_view kind() const override { return "planes_square"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
};

/// Two surfaces on one plane, with the same free side. Variables: plane a, plane b. Residual: the two rows of
/// PlanesParallelFactor, then the signed distance of the point `near` from b minus its signed distance from a [m].
/// `near` is a point in the map near both surfaces.
class PlanesAlignedFactor : public graph::SizedFactor<3, plane_factors::PlaneKind, plane_factors::PlaneKind> {
 public:
  explicit PlanesAlignedFactor(const Eigen::Vector3d& near_in_map) : near_(near_in_map) {}

  std::string_view kind() const override { return "planes_aligned"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  Eigen::Vector3d near_;
};

/// The last row of PlanesAlignedFactor, for two planes that other relations hold parallel. Variables: plane a, plane b.
/// Residual: the signed distance of the point `near` from b minus its signed distance from a [m].
class PlaneShiftFactor : public graph::SizedFactor<1, plane_factors::PlaneKind, plane_factors::PlaneKind> {
 public:
  explicit PlaneShiftFactor(const Eigen::Vector3d& near_in_map) : near_(near_in_map) {}

  std::string_view kind() const override { return "plane_shift"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  Eigen::Vector3d near_;
};

/// Registers the readers of these factors.
void addRelationsTo(graph::FactorRegistry& registry);

}  // namespace omnimapper::plugins
