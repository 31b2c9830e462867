#include "omnimapper/graph/Between.h"

#include "PoseIo.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

using RowMatrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

}  // namespace

BetweenSe2::BetweenSe2(const geometry::Se2& a_from_b)
    : a_from_b_(a_from_b), cosine_(std::cos(a_from_b.yaw)), sine_(std::sin(a_from_b.yaw)) {}

const std::vector<std::string_view>& BetweenSe2::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se2", "se2"};
  return kinds;
}

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
  if (jacobians[0])
    Eigen::Map<RowMatrix3>{jacobians[0]} << -cosine_, -sine_, cosine_ * y - sine_ * x,  //
        sine_, -cosine_, -sine_ * y - cosine_ * x,                                      //
        0, 0, -1;
  if (jacobians[1]) {
    const double turn = b[2] - a[2] - a_from_b_.yaw, c = std::cos(turn), s = std::sin(turn);
    Eigen::Map<RowMatrix3>{jacobians[1]} << c, -s, 0, s, c, 0, 0, 0, 1;
  }
}

void BetweenSe2::write(std::ostream& out) const {
  writePose(out, a_from_b_);
}

const std::vector<std::string_view>& BetweenSe3::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se3", "se3"};
  return kinds;
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
  if (jacobians[0]) {
    const Eigen::Matrix3d back = measured_back.toRotationMatrix();
    Eigen::Map<RowMatrix6>{jacobians[0]} << -back, back * geometry::skew(b_in_a), Eigen::Matrix3d::Zero(),
        -turn_jacobian * rotation.toRotationMatrix().transpose();
  }
  if (jacobians[1])
    Eigen::Map<RowMatrix6>{jacobians[1]} << error.toRotationMatrix(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(),
        turn_jacobian;
}

void BetweenSe3::write(std::ostream& out) const {
  writePose(out, a_from_b_);
}

}  // namespace omnimapper::graph
