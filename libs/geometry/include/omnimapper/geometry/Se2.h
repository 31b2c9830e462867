#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "omnimapper/geometry/Angle.h"

namespace omnimapper::geometry {

/// A motion of the plane: a_from_b takes points of frame b to frame a. Tangent: a small change is applied on the right
/// side. Its order is (x, y) [m] in the axes of the frame that moves, then yaw [rad].
struct Se2 {
  double x = 0;    ///< [m]
  double y = 0;    ///< [m]
  double yaw = 0;  ///< [rad], in (-pi, pi] in all results of the functions in this file

  Eigen::Vector2d translation() const { return {x, y}; }
  Eigen::Matrix2d rotation() const { return Eigen::Rotation2Dd(yaw).toRotationMatrix(); }
};

/// a_from_c = a_from_b * b_from_c.
inline Se2 operator*(const Se2& a, const Se2& b) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, wrapToPi(a.yaw + b.yaw)};
}

/// p_in_a = a_from_b * p_in_b.
inline Eigen::Vector2d operator*(const Se2& a, const Eigen::Vector2d& p) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {a.x + c * p.x() - s * p.y(), a.y + s * p.x() + c * p.y()};
}

inline Se2 inverse(const Se2& a) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, wrapToPi(-a.yaw)};
}

/// For a pose a with position p and rotation R: a plus (t, w) = (p + R t, yaw + w).
inline Se2 plus(const Se2& a, const Eigen::Vector3d& delta) {
  return a * Se2{delta[0], delta[1], delta[2]};
}

/// The change `delta` for which plus(a, delta) = b.
inline Eigen::Vector3d minus(const Se2& b, const Se2& a) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw), x = b.x - a.x, y = b.y - a.y;
  return {c * x + s * y, c * y - s * x, wrapToPi(b.yaw - a.yaw)};
}

/// The adjoint matrix Ad of a: a * plus(I, d) = plus(I, Ad d) * a to first order in d, where I is the identity.
inline Eigen::Matrix3d adjoint(const Se2& a) {
  Eigen::Matrix3d ad = Eigen::Matrix3d::Identity();
  ad.topLeftCorner<2, 2>() = a.rotation();
  ad(0, 2) = a.y;
  ad(1, 2) = -a.x;
  return ad;
}

}  // namespace omnimapper::geometry
