#include "RangeBearingFactor.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/ByteIo.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

using geometry::Se3;
using geometry::wrapToPi;

// At the sensor, and straight above it, directions are undefined: the bound keeps numbers finite there, and changes
// nothing elsewhere.
constexpr double kNearestPoint = 1e-9;  // [m]

}  // namespace

void RangeBearingFactor2::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const double *base = values[0], *point = values[1];
  const double c = std::cos(base[2]), s = std::sin(base[2]), dx = point[0] - base[0], dy = point[1] - base[1];
  const Eigen::Vector2d in_base(c * dx + s * dy, c * dy - s * dx);
  const Eigen::Vector2d d = in_base - sensor_in_base_;
  const double range = std::max(d.norm(), kNearestPoint);
  residual[0] = range - range_;
  residual[1] = wrapToPi(std::atan2(d.y(), d.x()) - bearing_);
  if (!jacobians) return;
  Eigen::Matrix2d by_d;
  by_d << d.x() / range, d.y() / range, -d.y() / (range * range), d.x() / (range * range);
  if (auto by_base = jacobian<0>(jacobians)) by_base << -by_d, by_d * Eigen::Vector2d(in_base.y(), -in_base.x());
  if (auto by_point = jacobian<1>(jacobians)) {
    Eigen::Matrix2d base_from_map;
    base_from_map << c, s, -s, c;
    by_point = by_d * base_from_map;
  }
}

void RangeBearingFactor2::write(std::ostream& out) const {
  graph::writeVector(out, Eigen::Vector4d(sensor_in_base_.x(), sensor_in_base_.y(), range_, bearing_));
}

void RangeBearingFactor2::addTo(graph::FactorRegistry& registry) {
  registry.add("range_bearing2", [](std::istream& in) {
    const Eigen::Vector4d numbers = graph::readVector<4>(in);
    return std::make_shared<RangeBearingFactor2>(numbers.head<2>(), numbers[2], numbers[3]);
  });
}

void RangeBearingFactor3::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const Se3 map_from_base = graph::se3FromValue(values[0]);
  const Eigen::Vector3d in_base = inverse(map_from_base) * Eigen::Map<const Eigen::Vector3d>(values[1]);
  const Eigen::Vector3d p = inverse(base_from_sensor_) * in_base;
  const double rho = std::max(p.head<2>().norm(), kNearestPoint), range = std::max(p.norm(), kNearestPoint);
  residual[0] = range - measured_[0];
  residual[1] = wrapToPi(std::atan2(p.y(), p.x()) - measured_[1]);
  residual[2] = wrapToPi(std::atan2(-p.z(), rho) - measured_[2]);
  if (!jacobians) return;
  Eigen::Matrix3d by_p;
  by_p.row(0) = p / range;
  by_p.row(1) = Eigen::Vector3d(-p.y(), p.x(), 0) / (rho * rho);
  by_p.row(2) = Eigen::Vector3d(p.x() * p.z() / rho, p.y() * p.z() / rho, -rho) / (range * range);
  const Eigen::Matrix3d by_in_base = by_p * base_from_sensor_.rotation.conjugate().toRotationMatrix();
  if (auto by_base = jacobian<0>(jacobians)) by_base << -by_in_base, by_in_base * geometry::skew(in_base);
  if (auto by_point = jacobian<1>(jacobians))
    by_point = by_in_base * map_from_base.rotation.conjugate().toRotationMatrix();
}

void RangeBearingFactor3::write(std::ostream& out) const {
  graph::writeVector(out, graph::toValue(base_from_sensor_));
  graph::writeVector(out, measured_);
}

void RangeBearingFactor3::addTo(graph::FactorRegistry& registry) {
  registry.add("range_bearing3", [](std::istream& in) {
    const geometry::Se3 base_from_sensor = graph::se3FromValue(graph::readVector<7>(in).data());
    return std::make_shared<RangeBearingFactor3>(base_from_sensor, graph::readVector<3>(in));
  });
}

}  // namespace omnimapper::plugins
