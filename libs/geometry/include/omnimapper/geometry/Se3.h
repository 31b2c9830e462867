#pragma once

#include "omnimapper/geometry/Rotation3.h"
#include "omnimapper/geometry/Se2.h"

namespace omnimapper::geometry {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A motion of space: a_from_b takes points of frame b to frame a. Tangent: a small change is applied on the right
/// side. Its order is x y z [m] in the axes of the frame that moves, then the rotation vector [rad]. Translation and
/// rotation change separately. (This is not the exponential of SE(3), but the same to first order.)
struct Se3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit quaternion
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

/// For a pose a with position p and rotation R: a plus (t, w) = (p + R t, R Exp(w)), where Exp is expSo3().
inline Se3 plus(const Se3& a, const Vector6d& delta) {
  return {(a.rotation * expSo3(delta.tail<3>())).normalized(), a.translation + a.rotation * delta.head<3>()};
}

/// The change `delta` for which plus(a, delta) = b; its rotation vector is at most pi long.
inline Vector6d minus(const Se3& b, const Se3& a) {
  const Eigen::Quaterniond back = a.rotation.conjugate();
  Vector6d delta;
  delta << back * (b.translation - a.translation), logSo3(back * b.rotation);
  return delta;
}

/// The adjoint matrix Ad of a: a * plus(I, d) = plus(I, Ad d) * a to first order in d, where I is the identity.
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

/// The planar part: x, y, and the yaw of the yaw-pitch-roll angles; z, pitch and roll are dropped. The inverse of
/// lift().
inline Se2 project(const Se3& a) {
  const Eigen::Quaterniond& q = a.rotation;
  const double yaw = std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
  return {a.translation.x(), a.translation.y(), wrapToPi(yaw)};
}

}  // namespace omnimapper::geometry
