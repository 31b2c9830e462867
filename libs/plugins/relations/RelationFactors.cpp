#include "RelationFactors.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/ByteIo.h>

#include <cmath>

namespace omnimapper::plugins {

namespace {

double headingOf(const geometry::Segment2& wall) {
  const Eigen::Vector2d along = geometry::direction(wall);
  return std::atan2(along.y(), along.x());
}

/// The distance of b's middle from a, and its derivatives by both.
struct Shift {
  double value;
  Eigen::RowVector2d by_a, by_b;

  Shift(const geometry::Segment2& a, const geometry::Segment2& b) {
    const Eigen::Vector2d between = middle(b) - middle(a);
    value = plane_factors::normalOf(a).dot(between);
    by_a << -direction(a).dot(between), -1;
    by_b << 0, plane_factors::normalOf(a).dot(plane_factors::normalOf(b));
  }
};

/// Derivative of a plane's normal by the tangent of the plane.
Eigen::Matrix3d normalByPlane(const geometry::Plane3& plane) {
  Eigen::Matrix3d by_plane = Eigen::Matrix3d::Zero();
  by_plane.leftCols<2>() = geometry::tangentBasis(plane.normal);
  return by_plane;
}

/// Derivative of the distance of a point by the tangent of the plane.
Eigen::RowVector3d distanceByPlane(const geometry::Plane3& plane, const Eigen::Vector3d& point) {
  return point.transpose() * normalByPlane(plane) + Eigen::RowVector3d::UnitZ();
}

/// The components of b's normal across a's, and their derivatives by both planes.
struct Across {
  Eigen::Vector2d value;
  Eigen::Matrix<double, 2, 3> by_a, by_b;

  Across(const geometry::Plane3& a, const geometry::Plane3& b) {
    const Eigen::Matrix<double, 3, 2> basis = geometry::tangentBasis(a.normal);
    value = basis.transpose() * b.normal;
    by_b = basis.transpose() * normalByPlane(b);
    // The basis depends on the normal: b1 is the unit axis e made perpendicular to n, b2 = n x b1.
    int axis = 0;
    a.normal.cwiseAbs().minCoeff(&axis);
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d square = along - a.normal * a.normal.dot(along);
    const double length = square.norm();
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d dn = basis.col(i);
      const Eigen::Vector3d dsquare = -dn * a.normal.dot(along) - a.normal * dn.dot(along);
      const Eigen::Vector3d db1 = (dsquare - basis.col(0) * basis.col(0).dot(dsquare)) / length;
      const Eigen::Vector3d db2 = dn.cross(basis.col(0)) + a.normal.cross(db1);
      by_a.col(i) << db1.dot(b.normal), db2.dot(b.normal);
    }
    by_a.col(2).setZero();
  }
};

// The distance of a point from a wall, by the point's x and y, and its derivatives.
struct FromWall {
  explicit FromWall(const double* const* values) {
    const geometry::Segment2 wall = plane_factors::wallFromValue(values[1]);
    const Eigen::Vector2d from_middle = Eigen::Vector2d(values[0][0], values[0][1]) - middle(wall);
    normal = plane_factors::normalOf(wall);
    distance = normal.dot(from_middle);
    by_wall << -direction(wall).dot(from_middle), -1;
  }

  Eigen::Vector2d normal;
  double distance;
  Eigen::RowVector2d by_wall;
};

}  // namespace

void PointOnWallFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const FromWall from(values);
  residual[0] = from.distance;
  if (!jacobians) return;
  if (auto by_point = jacobian<0>(jacobians)) by_point = from.normal.transpose();
  if (auto by_wall = jacobian<1>(jacobians)) by_wall = from.by_wall;
}

void Point3OnWallFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const FromWall from(values);
  residual[0] = from.distance;
  if (!jacobians) return;
  if (auto by_point = jacobian<0>(jacobians)) by_point << from.normal.transpose(), 0;
  if (auto by_wall = jacobian<1>(jacobians)) by_wall = from.by_wall;
}

void Point3OnWallFactor::write(std::ostream&) const {}

void PointOnWallFactor::write(std::ostream&) const {}

void PointOnPlaneFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Plane3 plane = plane_factors::planeFromValue(values[1]);
  const Eigen::Vector3d point(values[0][0], values[0][1], values[0][2]);
  residual[0] = signedDistance(plane, point);
  if (!jacobians) return;
  if (auto by_point = jacobian<0>(jacobians)) by_point = plane.normal.transpose();
  if (auto by_plane = jacobian<1>(jacobians)) by_plane << point.transpose() * geometry::tangentBasis(plane.normal), 1;
}

void PointOnPlaneFactor::write(std::ostream&) const {}

void WallTurnFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  residual[0] = geometry::wrapToPi(headingOf(plane_factors::wallFromValue(values[1])) -
                                   headingOf(plane_factors::wallFromValue(values[0])) - quarters_ * geometry::kPi / 2);
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a << -1, 0;
  if (auto by_b = jacobian<1>(jacobians)) by_b << 1, 0;
}

void WallTurnFactor::write(std::ostream& out) const {
  graph::writeUint(out, static_cast<std::uint64_t>(quarters_), 1);
}

void WallsAlignedFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Segment2 a = plane_factors::wallFromValue(values[0]), b = plane_factors::wallFromValue(values[1]);
  const Shift shift(a, b);
  residual[0] = geometry::wrapToPi(headingOf(b) - headingOf(a));
  residual[1] = shift.value;
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a << -1, 0, shift.by_a;
  if (auto by_b = jacobian<1>(jacobians)) by_b << 1, 0, shift.by_b;
}

void WallsAlignedFactor::write(std::ostream&) const {}

void WallShiftFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Shift shift(plane_factors::wallFromValue(values[0]), plane_factors::wallFromValue(values[1]));
  residual[0] = shift.value;
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a = shift.by_a;
  if (auto by_b = jacobian<1>(jacobians)) by_b = shift.by_b;
}

void WallShiftFactor::write(std::ostream&) const {}

void PlanesParallelFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Across across(plane_factors::planeFromValue(values[0]), plane_factors::planeFromValue(values[1]));
  Eigen::Map<Eigen::Vector2d>{residual} = across.value;
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a = across.by_a;
  if (auto by_b = jacobian<1>(jacobians)) by_b = across.by_b;
}

void PlanesParallelFactor::write(std::ostream&) const {}

void PlanesSquareFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Plane3 a = plane_factors::planeFromValue(values[0]), b = plane_factors::planeFromValue(values[1]);
  residual[0] = a.normal.dot(b.normal);
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a = b.normal.transpose() * normalByPlane(a);
  if (auto by_b = jacobian<1>(jacobians)) by_b = a.normal.transpose() * normalByPlane(b);
}

void PlanesSquareFactor::write(std::ostream&) const {}

void PlanesAlignedFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Plane3 a = plane_factors::planeFromValue(values[0]), b = plane_factors::planeFromValue(values[1]);
  const Across across(a, b);
  Eigen::Map<Eigen::Vector2d>{residual} = across.value;
  residual[2] = signedDistance(b, near_) - signedDistance(a, near_);
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a << across.by_a, -distanceByPlane(a, near_);
  if (auto by_b = jacobian<1>(jacobians)) by_b << across.by_b, distanceByPlane(b, near_);
}

void PlanesAlignedFactor::write(std::ostream& out) const {
  graph::writeVector(out, near_);
}

void PlaneShiftFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Plane3 a = plane_factors::planeFromValue(values[0]), b = plane_factors::planeFromValue(values[1]);
  residual[0] = signedDistance(b, near_) - signedDistance(a, near_);
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians)) by_a = -distanceByPlane(a, near_);
  if (auto by_b = jacobian<1>(jacobians)) by_b = distanceByPlane(b, near_);
}

void PlaneShiftFactor::write(std::ostream& out) const {
  graph::writeVector(out, near_);
}

void addRelationsTo(graph::FactorRegistry& registry) {
  registry.add("point_on_wall", [](std::istream&) { return std::make_shared<PointOnWallFactor>(); });
  registry.add("point3_on_wall", [](std::istream&) { return std::make_shared<Point3OnWallFactor>(); });
  registry.add("point_on_plane", [](std::istream&) { return std::make_shared<PointOnPlaneFactor>(); });
  registry.add("wall_turn", [](std::istream& in) {
    return std::make_shared<WallTurnFactor>(static_cast<int>(graph::readUint(in, 1)));
  });
  registry.add("walls_aligned", [](std::istream&) { return std::make_shared<WallsAlignedFactor>(); });
  registry.add("wall_shift", [](std::istream&) { return std::make_shared<WallShiftFactor>(); });
  registry.add("planes_parallel", [](std::istream&) { return std::make_shared<PlanesParallelFactor>(); });
  registry.add("planes_square", [](std::istream&) { return std::make_shared<PlanesSquareFactor>(); });
  registry.add("planes_aligned",
               [](std::istream& in) { return std::make_shared<PlanesAlignedFactor>(graph::readVector<3>(in)); });
  registry.add("plane_shift",
               [](std::istream& in) { return std::make_shared<PlaneShiftFactor>(graph::readVector<3>(in)); });
}

}  // namespace omnimapper::plugins
