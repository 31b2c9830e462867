#include "omnimapper/graph/Between.h"

#include <omnimapper/geometry/Angle.h>

#include "omnimapper/graph/ByteIo.h"

namespace omnimapper::graph {

BetweenSe2::BetweenSe2(const geometry::Se2& a_from_b)
    : a_from_b_(a_from_b), cosine_(std::cos(a_from_b.yaw)), sine_(std::sin(a_from_b.yaw)) {}

void BetweenSe2::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const double* a = values[0];
  const double* b = values[1];
  const double ca = std::cos(a[2]), sa = std::sin(a[2]), dx = b[0] - a[0], dy = b[1] - a[1];
  const double x = ca * dx + sa * dy, y = ca * dy - sa * dx;  // b in a
  const double ex = x - a_from_b_.x, ey = y - a_from_b_.y;
  residual[0] = cosine_ * ex + sine_ * ey;
  residual[1] = cosine_ * ey - sine_ * ex;
  residual[2] = geometry::wrapToPi(b[2] - a[2] - a_from_b_.yaw);
  if (!jacobians) return;
  if (auto by_a = jacobian<0>(jacobians))
    by_a << -cosine_, -sine_, cosine_ * y - sine_ * x,  //
        sine_, -cosine_, -sine_ * y - cosine_ * x,      //
        0, 0, -1;
  if (auto by_b = jacobian<1>(jacobians)) {
    const double turn = b[2] - a[2] - a_from_b_.yaw, c = std::cos(turn), s = std::sin(turn);
    by_b << c, -s, 0, s, c, 0, 0, 0, 1;
  }
}

std::optional<double> BetweenSe2::outlierVolume(const Eigen::Vector3d& map_size) const {
  return map_size.x() * map_size.y() * 2 * geometry::kPi;
}

void BetweenSe2::write(std::ostream& out) const {
  writeVector(out, toValue(a_from_b_));
}

void BetweenSe3::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_a = se3FromValue(values[0]), map_from_b = se3FromValue(values[1]);
  const Eigen::Quaterniond a_from_map = map_from_a.rotation.conjugate();
  const Eigen::Quaterniond rotation = a_from_map * map_from_b.rotation;
  const Eigen::Vector3d b_in_a = a_from_map * (map_from_b.translation - map_from_a.translation);
  const Eigen::Quaterniond measured_back = a_from_b_.rotation.conjugate();
  const Eigen::Quaterniond error = measured_back * rotation;
  const Eigen::Vector3d turn = geometry::logSo3(error);
  Eigen::Map<geometry::Vector6d> r(residual);
  r << measured_back * (b_in_a - a_from_b_.translation), turn;
  if (!jacobians) return;
  const Eigen::Matrix3d turn_jacobian = geometry::inverseRightJacobianSo3(turn);
  if (auto by_a = jacobian<0>(jacobians)) {
    const Eigen::Matrix3d back = measured_back.toRotationMatrix();
    by_a << -back, back * geometry::skew(b_in_a), Eigen::Matrix3d::Zero(),
        -turn_jacobian * rotation.toRotationMatrix().transpose();
  }
  if (auto by_b = jacobian<1>(jacobians))
    by_b << error.toRotationMatrix(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), turn_jacobian;
}

std::optional<double> BetweenSe3::outlierVolume(const Eigen::Vector3d& map_size) const {
  return map_size.prod() * 8 * geometry::kPi * geometry::kPi;
}

void BetweenSe3::write(std::ostream& out) const {
  writeVector(out, toValue(a_from_b_));
}

}  // namespace omnimapper::graph
