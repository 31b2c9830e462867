#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::geometry {

/// The matrix of the cross product: skew(a) * b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The rotation about the axis `w` by the length of `w` [rad].
inline Eigen::Quaterniond expSo3(const Eigen::Vector3d& w) {
  const double squared = w.squaredNorm();
  double real, factor;  // factor = sin(angle / 2) / angle
  if (squared < 1e-8) {
    real = 1 - squared / 8;
    factor = 0.5 - squared / 48;
  } else {
    const double angle = std::sqrt(squared);
    real = std::cos(0.5 * angle);
    factor = std::sin(0.5 * angle) / angle;
  }
  return {real, factor * w.x(), factor * w.y(), factor * w.z()};
}

/// Inverse of expSo3() for a unit quaternion of either sign: the rotation vector, whose length is in [0, pi].
inline Eigen::Vector3d logSo3(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  // angle / sin(angle / 2)
  const double factor =
      sine < 1e-5 ? 2 / cosine * (1 - sine * sine / (3 * cosine * cosine)) : 2 * std::atan2(sine, cosine) / sine;
  return sign * factor * q.vec();
}

/// The inverse of the right Jacobian Jr(w): logSo3(expSo3(w) expSo3(d)) = w + Jr(w)^-1 d for small d. For |w| < 2 pi.
inline Eigen::Matrix3d inverseRightJacobianSo3(const Eigen::Vector3d& w) {
  const double squared = w.squaredNorm();
  double c;  // 1 / t^2 - cot(t / 2) / (2 t)
  if (squared < 1e-5) {
    c = 1.0 / 12 + squared / 720;
  } else {
    const double angle = std::sqrt(squared);
    c = 1 / squared - 0.5 / (angle * std::tan(0.5 * angle));
  }
  const Eigen::Matrix3d s = skew(w);
  return Eigen::Matrix3d::Identity() + 0.5 * s + c * s * s;
}

}  // namespace omnimapper::geometry
