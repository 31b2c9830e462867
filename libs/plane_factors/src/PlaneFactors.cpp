#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plane_factors/PlaneFactors.h>

#include <cmath>

namespace omnimapper::plane_factors {

namespace {

using geometry::Plane3;
using geometry::Se3;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

/// A plane of the map in the frame of the base, with the derivatives of its normal and distance.
struct PredictedPlane {
  Plane3 in_base;
  Matrix36 normal_by_pose = Matrix36::Zero();
  Eigen::Matrix<double, 1, 6> distance_by_pose = Eigen::Matrix<double, 1, 6>::Zero();
  Eigen::Matrix3d normal_by_plane = Eigen::Matrix3d::Zero();
  Eigen::RowVector3d distance_by_plane;

  explicit PredictedPlane(const double* const* values) {
    const Se3 map_from_base = graph::se3FromValue(values[0]);
    const Plane3 in_map = planeFromValue(values[1]);
    const Eigen::Matrix3d base_from_map = map_from_base.rotation.conjugate().toRotationMatrix();
    const Eigen::Matrix<double, 3, 2> basis = geometry::tangentBasis(in_map.normal);
    in_base.normal = base_from_map * in_map.normal;
    in_base.distance = signedDistance(in_map, map_from_base.translation);
    normal_by_pose.rightCols<3>() = geometry::skew(in_base.normal);
    distance_by_pose.leftCols<3>() = in_base.normal.transpose();
    normal_by_plane.leftCols<2>() = base_from_map * basis;
    distance_by_plane << map_from_base.translation.transpose() * basis, 1;
  }
};

}  // namespace

void PlaneFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const PredictedPlane predicted(values);
  Eigen::Map<Eigen::Vector3d>{residual} = geometry::minus(predicted.in_base, measured_);
  if (!jacobians) return;
  // The rotation is u theta / s, with u the part of the normal across the measured one, s = |u|, theta = atan2(s, c).
  const Eigen::Matrix<double, 2, 3> across = geometry::tangentBasis(measured_.normal).transpose();
  const Eigen::Vector2d u = across * predicted.in_base.normal;
  const double s = u.norm(), c = measured_.normal.dot(predicted.in_base.normal);
  Eigen::Matrix<double, 2, 3> turn_by_normal = across;
  if (s > 1e-7) {
    const double theta = std::atan2(s, c);
    const Eigen::RowVector3d s_by_normal = u.transpose() * across / s;
    const Eigen::RowVector3d theta_by_normal = c * s_by_normal - s * measured_.normal.transpose();
    turn_by_normal = theta / s * across + u / s * (theta_by_normal - theta / s * s_by_normal);
  }
  if (auto by_pose = jacobian<0>(jacobians)) {
    by_pose.topRows<2>() = turn_by_normal * predicted.normal_by_pose;
    by_pose.bottomRows<1>() = predicted.distance_by_pose;
  }
  if (auto by_plane = jacobian<1>(jacobians)) {
    by_plane.topRows<2>() = turn_by_normal * predicted.normal_by_plane;
    by_plane.bottomRows<1>() = predicted.distance_by_plane;
  }
}

void PlaneFactor::write(std::ostream& out) const {
  graph::writeVector(out, toValue(measured_));
}

void PlaneFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("plane_from_se3", [](std::istream& in) {
    return std::make_shared<PlaneFactor>(planeFromValue(graph::readVector<4>(in).data()));
  });
}

void LineOnPlaneFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const PredictedPlane predicted(values);
  residual[0] = predicted.in_base.normal.dot(direction_);
  residual[1] = signedDistance(predicted.in_base, middle_);
  if (!jacobians) return;
  Eigen::Matrix<double, 2, 3> by_normal;
  by_normal << direction_.transpose(), middle_.transpose();
  if (auto by_pose = jacobian<0>(jacobians)) {
    by_pose = by_normal * predicted.normal_by_pose;
    by_pose.row(1) += predicted.distance_by_pose;
  }
  if (auto by_plane = jacobian<1>(jacobians)) {
    by_plane = by_normal * predicted.normal_by_plane;
    by_plane.row(1) += predicted.distance_by_plane;
  }
}

void LineOnPlaneFactor::write(std::ostream& out) const {
  graph::writeVector(out, direction_);
  graph::writeVector(out, middle_);
}

void LineOnPlaneFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("line_on_plane", [](std::istream& in) {
    const Eigen::Vector3d direction = graph::readVector<3>(in);
    return std::make_shared<LineOnPlaneFactor>(direction, graph::readVector<3>(in));
  });
}

void UprightFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Plane3 plane = planeFromValue(values[0]);
  // The tangent is unbounded for a nearly level plane, so the cosine has a lower limit.
  constexpr double kLeastCosine = 0.01;
  const double sine = plane.normal.z(), square = 1 - sine * sine;
  const bool is_level = square < kLeastCosine * kLeastCosine;
  const double cosine = is_level ? kLeastCosine : std::sqrt(square);
  residual[0] = sine / cosine;
  auto by_plane = jacobian<0>(jacobians);
  if (!by_plane) return;
  const double by_sine = is_level ? 1 / cosine : 1 / (cosine * square);
  by_plane << by_sine * geometry::tangentBasis(plane.normal).row(2), 0;
}

void UprightFactor::write(std::ostream&) const {}

void UprightFactor::addTo(graph::FactorRegistry& registry) {
  registry.add(std::string(kKind), [](std::istream&) { return std::make_shared<UprightFactor>(); });
}

}  // namespace omnimapper::plane_factors
