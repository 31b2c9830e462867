#include "omnimapper/graph/PointFactor.h"

#include <omnimapper/base/Error.h>

#include <cmath>

#include "omnimapper/graph/ByteIo.h"

namespace omnimapper::graph {

void PointFactor2::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const double* base = values[0];
  const double* point = values[1];
  const double c = std::cos(base[2]), s = std::sin(base[2]), dx = point[0] - base[0], dy = point[1] - base[1];
  const double x = c * dx + s * dy, y = c * dy - s * dx;
  residual[0] = x - point_in_base_.x();
  residual[1] = y - point_in_base_.y();
  if (!jacobians) return;
  if (auto by_base = jacobian<0>(jacobians)) by_base << -1, 0, y, 0, -1, -x;
  if (auto by_point = jacobian<1>(jacobians)) by_point << c, s, -s, c;
}

void PointFactor2::write(std::ostream& out) const {
  writeVector(out, point_in_base_);
}

void PointFactor3::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se3 map_from_base = se3FromValue(values[0]);
  const Eigen::Matrix3d base_from_map = map_from_base.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d predicted =
      base_from_map * (Eigen::Map<const Eigen::Vector3d>(values[1]) - map_from_base.translation);
  Eigen::Map<Eigen::Vector3d>{residual} = predicted - point_in_base_;
  if (!jacobians) return;
  if (auto by_base = jacobian<0>(jacobians)) by_base << -Eigen::Matrix3d::Identity(), geometry::skew(predicted);
  if (auto by_point = jacobian<1>(jacobians)) by_point = base_from_map;
}

void PointFactor3::write(std::ostream& out) const {
  writeVector(out, point_in_base_);
}

void SamePointFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  Eigen::Map<Eigen::Vector3d>{residual} =
      Eigen::Map<const Eigen::Vector3d>(values[1]) - Eigen::Map<const Eigen::Vector3d>(values[0]);
  if (!jacobians) return;
  if (auto by_first = jacobian<0>(jacobians)) by_first = -Eigen::Matrix3d::Identity();
  if (auto by_second = jacobian<1>(jacobians)) by_second = Eigen::Matrix3d::Identity();
}

std::optional<double> SamePointFactor::outlierVolume(const Eigen::Vector3d& map_size) const {
  return odds_ * map_size.prod();
}

void SamePointFactor::write(std::ostream& out) const {
  writeDouble(out, odds_);
}

std::shared_ptr<SamePointFactor> SamePointFactor::read(std::istream& in) {
  const bool is_old = in.peek() == std::istream::traits_type::eof();  // written by a version without odds
  const double odds = is_old ? 1 : readDouble(in);
  if (!(odds > 0) || !std::isfinite(odds))
    throw base::Error(base::ExitCode::damaged_input,
                      "graph: the odds that two points are the same are not a positive number");
  return std::make_shared<SamePointFactor>(odds);
}

}  // namespace omnimapper::graph
