#include "SignBearingFactor.h"

#include <omnimapper/graph/ByteIo.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

using Eigen::Vector2d;
using Eigen::Vector3d;

SignBearingFactor::SignBearingFactor(const Vector3d& camera, const Vector3d& direction)
    : camera_(camera), direction_(direction) {
  const Vector3d left = Vector3d::UnitZ().cross(direction).normalized();
  across_.row(0) = left;
  across_.row(1) = left.cross(direction);
}

void SignBearingFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_base = graph::se3FromValue(values[0]);
  const Eigen::Matrix3d base_from_map = map_from_base.rotation.conjugate().toRotationMatrix();
  const Vector3d in_base = base_from_map * (Eigen::Map<const Vector3d>(values[1]) - map_from_base.translation);
  const Vector3d seen = in_base - camera_;
  // The angle to the direction over the sine's share of it: 1 / ahead where both are small.
  const Vector2d aside = across_ * seen;
  const double ahead = direction_.dot(seen), sine = aside.norm();
  const double squared = std::max(sine * sine + ahead * ahead, 1e-18), angle = std::atan2(sine, ahead);
  constexpr double kSmall = 1e-4, kNearest = 1e-9;  // [1] [m]
  if (ahead < kNearest && sine < kNearest) {  // straight behind the camera, or in it: no direction leads to the point
    residual[0] = ahead < 0 ? angle : 0;
    residual[1] = 0;
    if (!jacobians) return;
    if (auto by_base = jacobian<0>(jacobians)) by_base.setZero();
    if (auto by_point = jacobian<1>(jacobians)) by_point.setZero();
    return;
  }
  const bool is_small = sine < kSmall * ahead;
  const double scale = is_small ? 1 / ahead : angle / std::max(sine, 1e-9);
  Eigen::Map<Vector2d>{residual} = scale * aside;
  if (!jacobians) return;
  const double by_sine = is_small ? -2 * sine / (3 * ahead * ahead * ahead)
                                  : (ahead * sine / squared - angle) / std::max(sine * sine, 1e-18);
  const double by_ahead = -1 / squared;
  const Vector2d unit = sine > 0 ? Vector2d(aside / sine) : Vector2d(Vector2d::Zero());
  const Eigen::Matrix<double, 2, 3> by_seen =
      scale * across_ + aside * (by_sine * unit.transpose() * across_ + by_ahead * direction_.transpose());
  if (auto by_base = jacobian<0>(jacobians)) by_base << -by_seen, by_seen * geometry::skew(in_base);
  if (auto by_point = jacobian<1>(jacobians)) by_point = by_seen * base_from_map;
}

void SignBearingFactor::write(std::ostream& out) const {
  graph::writeVector(out, camera_);
  graph::writeVector(out, direction_);
}

void SignBearingFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("sign_bearing", [](std::istream& in) {
    const Vector3d camera = graph::readVector<3>(in);
    return std::make_shared<SignBearingFactor>(camera, graph::readVector<3>(in));
  });
}

}  // namespace omnimapper::plugins
