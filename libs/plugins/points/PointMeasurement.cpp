#include "PointMeasurement.h"

#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "RangeBearingFactor.h"

namespace omnimapper::plugins {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using geometry::Se3;
using mrpt::obs::CObservationBearingRange;

// Covariance of range, yaw and pitch.
Matrix3d covarianceOfMeasurement(const CObservationBearingRange& observation,
                                 const CObservationBearingRange::TMeasurement& measured,
                                 const PointLandmarksOptions& options) {
  Matrix3d covariance = Matrix3d::Zero();
  if (observation.validCovariances) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) covariance(row, column) = measured.covariance(row, column);
  } else {
    covariance.diagonal() =
        Vector3d(observation.sensor_std_range, observation.sensor_std_yaw, observation.sensor_std_pitch).cwiseAbs2();
  }
  const double configured[] = {options.sigma_range, options.sigma_yaw, options.sigma_pitch};
  for (int i = 0; i < 3; ++i) {
    if (!(configured[i] > 0)) continue;
    covariance.row(i).setZero();
    covariance.col(i).setZero();
    covariance(i, i) = configured[i] * configured[i];
  }
  return covariance;
}

bool isUsableCovariance(const Eigen::MatrixXd& matrix) {
  return matrix.allFinite() && Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
}

PointMeasurement uselessMeasurement(const CObservationBearingRange::TMeasurement& measured, const std::string& why) {
  return {measured.landmarkID, measured.range, std::nullopt, why};
}

// The point in the frame of the sensor, with its derivative by range, yaw and pitch.
struct PointRay {
  Vector3d point;
  Matrix3d by_measured;

  explicit PointRay(const Vector3d& range_yaw_pitch) {
    const double range = range_yaw_pitch[0];
    const double cy = std::cos(range_yaw_pitch[1]), sy = std::sin(range_yaw_pitch[1]);
    const double cp = std::cos(range_yaw_pitch[2]), sp = std::sin(range_yaw_pitch[2]);
    const Vector3d direction(cp * cy, cp * sy, -sp);
    point = range * direction;
    by_measured << direction, range * Vector3d(-cp * sy, cp * cy, 0), range * Vector3d(-sp * cy, -sp * sy, -cp);
  }
};

// doc/derivations/range_bearing.md, "In a planar map".
std::optional<PointConstraint> constraintOverFloor(const PointRay& ray, const Matrix3d& covariance,
                                                   const Se3& base_from_sensor) {
  const Vector3d from_sensor = base_from_sensor.rotation * ray.point;
  const Eigen::Matrix<double, 2, 3> by_measured =
      (base_from_sensor.rotation.toRotationMatrix() * ray.by_measured).topRows<2>();
  const Eigen::Vector2d v = from_sensor.head<2>();
  const double rho = v.norm();
  if (rho < 1e-3 * from_sensor.norm()) return std::nullopt;
  Eigen::Matrix2d polar;
  polar << v.transpose() / rho, -v.y() / (rho * rho), v.x() / (rho * rho);
  const Eigen::Matrix<double, 2, 3> polar_by_measured = polar * by_measured;
  const Eigen::Matrix2d rounded = polar_by_measured * covariance * polar_by_measured.transpose();
  const Eigen::Matrix2d of_polar = (rounded + rounded.transpose()) / 2;  // rounding alone can make it asymmetric
  if (!isUsableCovariance(of_polar)) return std::nullopt;
  return PointConstraint{
      base_from_sensor * ray.point, std::max(std::sqrt(of_polar(0, 0)), rho * std::sqrt(of_polar(1, 1))),
      std::make_shared<RangeBearingFactor2>(base_from_sensor.translation.head<2>(), rho, std::atan2(v.y(), v.x())),
      graph::SquareRootInformation::fromCovariance(of_polar)};
}

std::optional<PointConstraint> constraintInSpace(const PointRay& ray, const Matrix3d& covariance,
                                                 const Se3& base_from_sensor) {
  const double range = ray.point.norm(), rho = ray.point.head<2>().norm();
  if (rho < 1e-3 * range || !isUsableCovariance(covariance)) return std::nullopt;
  // A pitch beyond 90 degrees is replaced by the yaw and pitch within 90 degrees of the same ray.
  const Vector3d measured(range, std::atan2(ray.point.y(), ray.point.x()), std::atan2(-ray.point.z(), rho));
  const Vector3d sigmas = covariance.diagonal().cwiseSqrt();
  return PointConstraint{base_from_sensor * ray.point, std::max(sigmas[0], range * std::max(sigmas[1], sigmas[2])),
                         std::make_shared<RangeBearingFactor3>(base_from_sensor, measured),
                         graph::SquareRootInformation::fromCovariance(covariance)};
}

}  // namespace

std::vector<PointMeasurement> pointMeasurements(const CObservationBearingRange& observation, mapper::Motion motion,
                                                const PointLandmarksOptions& options) {
  const Se3 base_from_sensor = geometry::fromMrpt(observation.sensorLocationOnRobot);
  std::vector<PointMeasurement> all;
  std::set<std::int32_t> seen;
  for (const auto& measured : observation.sensedData) {
    const Vector3d range_yaw_pitch(measured.range, measured.yaw, measured.pitch);
    if (!range_yaw_pitch.allFinite() || !(measured.range > 0)) {
      all.push_back(uselessMeasurement(measured, "no finite range and bearing"));
      continue;
    }
    if (measured.landmarkID >= 0 && !seen.insert(measured.landmarkID).second) {
      all.push_back(uselessMeasurement(measured, "its number occurs twice in the observation"));
      continue;
    }
    const PointRay ray(range_yaw_pitch);
    const Matrix3d covariance = covarianceOfMeasurement(observation, measured, options);
    auto constraint = motion == mapper::Motion::planar ? constraintOverFloor(ray, covariance, base_from_sensor)
                                                       : constraintInSpace(ray, covariance, base_from_sensor);
    const bool taken = constraint.has_value();
    all.push_back({std::max(measured.landmarkID, -1), measured.range, std::move(constraint),
                   taken ? "" : "straight above or below the sensor, or without standard deviations"});
  }
  return all;
}

}  // namespace omnimapper::plugins
