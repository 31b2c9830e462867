#pragma once

#include "omnimapper/geometry/Rotation3.h"
#include "omnimapper/geometry/Se2.h"

namespace omnimapper::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A motion of space: a_from_b takes points of frame b to frame a.
/// Tangent: right perturbation, order x y z [m] in the moved frame, then rotation vector [rad]; translation and
/// rotation change separately (not by the SE(3) exponential), which to first order is the same.
struct Se3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< [m]
};

/// a_from_c = a_from_b * b_from_c.
inline Se3 operator*(const Se3& a, const Se3& b) {
  return {(a.rotation * b.rotation).normalized(), a.translation + a.rotation * b.translation};
}

/// p_in_a = a_from_b * p_in_b.
inline Eigen::Vector3d operator*(const Se3& a, const Eigen::Vector3d& p) {
  return a.translation + a.rotation * p;
}

inline Se3 inverse(const Se3& a) {
  const Eigen::Quaterniond back = a.rotation.conjugate();
  return {back, -(back * a.translation)};
}

/// a plus (t, w) = (p + R t, R Exp(w)).
inline Se3 plus(const Se3& a, const Vector6d& delta) {
  return {(a.rotation * expSo3(delta.tail<3>())).normalized(), a.translation + a.rotation * delta.head<3>()};
}

/// delta such that plus(a, delta) = b; its rotation vector is at most pi long.
inline Vector6d minus(const Se3& b, const Se3& a) {
  const Eigen::Quaterniond back = a.rotation.conjugate();
  Vector6d delta;
  delta << back * (b.translation - a.translation), logSo3(back * b.rotation);
  return delta;
}

/// Ad(a): a * plus(I, d) = plus(I, Ad d) * a to first order in d.
inline Matrix6d adjoint(const Se3& a) {
  const Eigen::Matrix3d r = a.rotation.toRotationMatrix();
  Matrix6d ad;
  ad << r, skew(a.translation) * r, Eigen::Matrix3d::Zero(), r;
  return ad;
}

/// The pose of a planar frame in space: z = 0, rotation about z.
inline Se3 lift(const Se2& a) {
  return {Eigen::Quaterniond(std::cos(0.5 * a.yaw), 0, 0, std::sin(0.5 * a.yaw)), {a.x, a.y, 0}};
}

/// The planar part: x, y, and the yaw of the yaw-pitch-roll angles; z, pitch and roll are dropped. lift()'s inverse.
inline Se2 project(const Se3& a) {
  const Eigen::Quaterniond& q = a.rotation;
  const double yaw = std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
  return {a.translation.x(), a.translation.y(), wrapToPi(yaw)};
}

}  // namespace omnimapper::geometry
