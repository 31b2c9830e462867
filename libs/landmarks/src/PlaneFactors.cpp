#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/landmarks/PlaneFactors.h>
#include <omnimapper/landmarks/PlaneVariable.h>

#include <cmath>

namespace omnimapper::landmarks {

namespace {

using geometry::Plane3;
using geometry::Se3;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

const std::vector<std::string_view>& poseAndPlane() {
  static const std::vector<std::string_view> kinds = {"se3", "plane"};
  return kinds;
}

/// A plane of the map as it is in the base, with how its normal and distance change.
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

void writeVector(std::ostream& out, const Eigen::Vector3d& vector) {
  for (const double number : vector) graph::writeDouble(out, number);
}

Eigen::Vector3d readVector(std::istream& in) {
  Eigen::Vector3d vector;
  for (double& number : vector) number = graph::readDouble(in);
  return vector;
}

template <int Rows, int Columns>
using RowMajorMap = Eigen::Map<Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>>;

}  // namespace

const std::vector<std::string_view>& PlaneFactor::variableKinds() const {
  return poseAndPlane();
}

void PlaneFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const PredictedPlane predicted(values);
  Eigen::Map<Eigen::Vector3d>{residual} = geometry::minus(predicted.in_base, measured_);
  if (!jacobians) return;
  // The turn is u theta / s, with u the part of the normal across the measured one, s = |u|, theta = atan2(s, c).
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
  if (jacobians[0]) {
    RowMajorMap<3, 6> by_pose(jacobians[0]);
    by_pose.topRows<2>() = turn_by_normal * predicted.normal_by_pose;
    by_pose.bottomRows<1>() = predicted.distance_by_pose;
  }
  if (jacobians[1]) {
    RowMajorMap<3, 3> by_plane(jacobians[1]);
    by_plane.topRows<2>() = turn_by_normal * predicted.normal_by_plane;
    by_plane.bottomRows<1>() = predicted.distance_by_plane;
  }
}

void PlaneFactor::write(std::ostream& out) const {
  writeVector(out, measured_.normal);
  graph::writeDouble(out, measured_.distance);
}

void PlaneFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("plane_from_se3", [](std::istream& in) {
    const Eigen::Vector3d normal = readVector(in);
    return std::make_shared<PlaneFactor>(Plane3{normal, graph::readDouble(in)});
  });
}

const std::vector<std::string_view>& LineOnPlaneFactor::variableKinds() const {
  return poseAndPlane();
}

void LineOnPlaneFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const PredictedPlane predicted(values);
  residual[0] = predicted.in_base.normal.dot(direction_);
  residual[1] = signedDistance(predicted.in_base, middle_);
  if (!jacobians) return;
  Eigen::Matrix<double, 2, 3> by_normal;
  by_normal << direction_.transpose(), middle_.transpose();
  if (jacobians[0]) {
    RowMajorMap<2, 6> by_pose(jacobians[0]);
    by_pose = by_normal * predicted.normal_by_pose;
    by_pose.row(1) += predicted.distance_by_pose;
  }
  if (jacobians[1]) {
    RowMajorMap<2, 3> by_plane(jacobians[1]);
    by_plane = by_normal * predicted.normal_by_plane;
    by_plane.row(1) += predicted.distance_by_plane;
  }
}

void LineOnPlaneFactor::write(std::ostream& out) const {
  writeVector(out, direction_);
  writeVector(out, middle_);
}

void LineOnPlaneFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("line_on_plane", [](std::istream& in) {
    const Eigen::Vector3d direction = readVector(in);
    return std::make_shared<LineOnPlaneFactor>(direction, readVector(in));
  });
}

const std::vector<std::string_view>& UprightFactor::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"plane"};
  return kinds;
}

void UprightFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Plane3 plane = planeFromValue(values[0]);
  // Nearly level the tangent is beyond all bounds; its cosine is held from there on.
  constexpr double kLeastCosine = 0.01;
  const double sine = plane.normal.z(), square = 1 - sine * sine;
  const bool is_level = square < kLeastCosine * kLeastCosine;
  const double cosine = is_level ? kLeastCosine : std::sqrt(square);
  residual[0] = sine / cosine;
  if (!jacobians || !jacobians[0]) return;
  const double by_sine = is_level ? 1 / cosine : 1 / (cosine * square);
  RowMajorMap<1, 3>(jacobians[0]) << by_sine * geometry::tangentBasis(plane.normal).row(2), 0;
}

void UprightFactor::write(std::ostream&) const {}

void UprightFactor::addTo(graph::FactorRegistry& registry) {
  registry.add(std::string(kKind), [](std::istream&) { return std::make_shared<UprightFactor>(); });
}

}  // namespace omnimapper::landmarks
