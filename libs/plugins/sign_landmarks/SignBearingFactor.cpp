#include "SignBearingFactor.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace omnimapper::plugins {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// A point of the map, in the axes of a base.
struct InBase {
  InBase(const double* map_from_base_value, const double* point) {
    const geometry::Se3 map_from_base = graph::se3FromValue(map_from_base_value);
    base_from_map = map_from_base.rotation.conjugate().toRotationMatrix();
    position = base_from_map * (Eigen::Map<const Vector3d>(point) - map_from_base.translation);
  }
  // Derivative of the position by the tangent of the base.
  Eigen::Matrix<double, 3, 6> byBase() const {
    Eigen::Matrix<double, 3, 6> by_base;
    by_base << -Eigen::Matrix3d::Identity(), geometry::skew(position);
    return by_base;
  }

  Eigen::Matrix3d base_from_map;
  Vector3d position;
};

bool isUnit(const Vector3d& vector) {
  return std::abs(vector.norm() - 1) < 1e-6;
}

[[noreturn]] void refuse(const std::string& what) {
  throw base::Error(base::ExitCode::damaged_input, "graph: " + what + ": damaged");
}

}  // namespace

MeasuredDirection::MeasuredDirection(const Vector3d& camera, const Vector3d& direction)
    : camera_(camera), direction_(direction) {
  const Vector3d left = Vector3d::UnitZ().cross(direction).normalized();
  across_.row(0) = left;
  across_.row(1) = left.cross(direction);
}

Vector2d MeasuredDirection::angleTo(const Vector3d& seen, Eigen::Matrix<double, 2, 3>* by_seen) const {
  // The residual is `aside`, scaled to the length of the angle: by angle / sine, which is 1 / ahead if both are small.
  const Vector2d aside = across_ * seen;
  const double ahead = direction_.dot(seen), sine = aside.norm();
  const double squared = std::max(sine * sine + ahead * ahead, 1e-18), angle = std::atan2(sine, ahead);
  constexpr double kSmall = 1e-4, kNearest = 1e-9;  // [1] [m]
  if (ahead < kNearest &&
      sine < kNearest) {  // straight behind the camera or at it: the direction to the point is undefined
    if (by_seen) by_seen->setZero();
    return {ahead < 0 ? angle : 0, 0};
  }
  const bool is_small = sine < kSmall * ahead;
  const double scale = is_small ? 1 / ahead : angle / std::max(sine, 1e-9);
  if (by_seen) {
    const double by_sine = is_small ? -2 * sine / (3 * ahead * ahead * ahead)
                                    : (ahead * sine / squared - angle) / std::max(sine * sine, 1e-18);
    const double by_ahead = -1 / squared;
    const Vector2d unit = sine > 0 ? Vector2d(aside / sine) : Vector2d(Vector2d::Zero());
    *by_seen = scale * across_ + aside * (by_sine * unit.transpose() * across_ + by_ahead * direction_.transpose());
  }
  return scale * aside;
}

void MeasuredDirection::write(std::ostream& out) const {
  graph::writeVector(out, camera_);
  graph::writeVector(out, direction_);
}

MeasuredDirection MeasuredDirection::read(std::istream& in) {
  const Vector3d camera = graph::readVector<3>(in), direction = graph::readVector<3>(in);
  if (!camera.allFinite() || !isUnit(direction) || !(direction.head<2>().norm() > 1e-6))
    refuse("the direction to a sign is vertical or not a unit vector");
  return {camera, direction};
}

void SignBearingFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const InBase point(values[0], values[1]);
  Eigen::Matrix<double, 2, 3> by_seen;
  Eigen::Map<Vector2d>{residual} =
      direction_.angleTo(point.position - direction_.camera(), jacobians ? &by_seen : nullptr);
  if (auto by_base = jacobian<0>(jacobians)) by_base = by_seen * point.byBase();
  if (auto by_point = jacobian<1>(jacobians)) by_point = by_seen * point.base_from_map;
}

void SignBearingFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("sign_bearing",
               [](std::istream& in) { return std::make_shared<SignBearingFactor>(MeasuredDirection::read(in)); });
}

void PanTiltBearingFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const InBase point(values[0], values[1]);
  const double pan = values[2][0], tilt = values[2][1];
  const Vector3d seen = point.position - direction_.camera();
  // The point as it would be seen without offsets: turned back by the pan, then by the tilt.
  const Eigen::Matrix3d unpan = Eigen::AngleAxisd(-pan, Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d untilt = Eigen::AngleAxisd(-tilt, tilt_axis_).toRotationMatrix();
  const Vector3d unpanned = unpan * seen, reported = untilt * unpanned;
  Eigen::Matrix<double, 2, 3> by_reported;
  Eigen::Map<Vector2d>{residual} = direction_.angleTo(reported, jacobians ? &by_reported : nullptr);
  if (!jacobians) return;
  const Eigen::Matrix<double, 2, 3> by_seen = by_reported * untilt * unpan;
  if (auto by_base = jacobian<0>(jacobians)) by_base = by_seen * point.byBase();
  if (auto by_point = jacobian<1>(jacobians)) by_point = by_seen * point.base_from_map;
  if (auto by_offsets = jacobian<2>(jacobians)) {
    by_offsets.col(0) = -(by_reported * untilt * Vector3d::UnitZ().cross(unpanned));
    by_offsets.col(1) = -(by_reported * tilt_axis_.cross(reported));
  }
}

void PanTiltBearingFactor::write(std::ostream& out) const {
  direction_.write(out);
  graph::writeVector(out, tilt_axis_);
}

void PanTiltBearingFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("sign_bearing_pan_tilt", [](std::istream& in) {
    const MeasuredDirection direction = MeasuredDirection::read(in);
    const Vector3d tilt_axis = graph::readVector<3>(in);
    if (!isUnit(tilt_axis)) refuse("the tilt axis of a camera is not a unit vector");
    return std::make_shared<PanTiltBearingFactor>(direction, tilt_axis);
  });
}

Vector3d turnedBy(const Vector2d& pan_tilt, const Vector3d& tilt_axis, const Vector3d& direction) {
  return Eigen::AngleAxisd(pan_tilt[0], Vector3d::UnitZ()) * (Eigen::AngleAxisd(pan_tilt[1], tilt_axis) * direction);
}

void SignRangeFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  constexpr double kNearest = 0.01;  // [m] at shorter distances, the logarithm continues as a straight line
  const InBase point(values[0], values[1]);
  const Vector3d seen = point.position - camera_;
  const double range = seen.norm(), capped = std::max(range, kNearest);
  residual[0] = std::log(capped / range_) + (range - capped) / kNearest;
  if (!jacobians) return;
  const Eigen::RowVector3d by_seen = range > 0 ? Eigen::RowVector3d(seen.transpose() / (range * capped))
                                               : Eigen::RowVector3d(Eigen::RowVector3d::Zero());
  if (auto by_base = jacobian<0>(jacobians)) by_base = by_seen * point.byBase();
  if (auto by_point = jacobian<1>(jacobians)) by_point = by_seen * point.base_from_map;
}

void SignRangeFactor::write(std::ostream& out) const {
  graph::writeVector(out, camera_);
  graph::writeDouble(out, range_);
}

void SignRangeFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("sign_range", [](std::istream& in) {
    const Vector3d camera = graph::readVector<3>(in);
    const double range = graph::readDouble(in);
    if (!camera.allFinite() || !(range > 0) || !std::isfinite(range))
      refuse("the range of a sign is not a positive number");
    return std::make_shared<SignRangeFactor>(camera, range);
  });
}

}  // namespace omnimapper::plugins
