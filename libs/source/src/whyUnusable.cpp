#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/ObservationGate.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::source {

using namespace mrpt::obs;

namespace {

using Reason = std::optional<std::string>;

constexpr const char* kNoCovariance =
    "the covariance is not valid: it is not finite, not symmetric, or has a negative variance in some direction";

// A stored quaternion that is not of length 1 gives a matrix that rotates and scales.
bool isPose(const mrpt::poses::CPose3D& pose) {
  constexpr double kRounding = 1e-3;
  const Eigen::Matrix3d rotation = pose.getRotationMatrix().asEigen();
  return pose.m_coords.asEigen().allFinite() &&
         (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRounding &&
         rotation.determinant() > 0;
}

// Whether the matrix is symmetric and positive semidefinite up to rounding, as some are stored as float. Correlations
// are checked, so that a large variance of one quantity hides no error of another. A quantity that is known exactly has
// variance 0.
bool isCovariance(const Eigen::MatrixXd& matrix) {
  constexpr double kRounding = 1e-6;
  if (!matrix.allFinite() || (matrix.diagonal().array() < 0).any()) return false;
  const Eigen::VectorXd deviations = matrix.diagonal().cwiseSqrt();
  Eigen::MatrixXd correlations = matrix;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      const double unit = deviations[row] * deviations[column];
      if (unit > 0)
        correlations(row, column) /= unit;
      else if (matrix(row, column) != 0)
        return false;
    }
  }
  if (!correlations.allFinite()) return false;
  if ((correlations - correlations.transpose()).cwiseAbs().maxCoeff() > kRounding) return false;
  return geometry::eigenvaluesOf<Eigen::Dynamic>(correlations)[0] >= -kRounding;
}

Reason whyNot(const mrpt::img::TCamera& camera) {
  const bool is_finite = std::isfinite(camera.fx()) && std::isfinite(camera.fy()) && std::isfinite(camera.cx()) &&
                         std::isfinite(camera.cy()) &&
                         std::all_of(camera.dist.begin(), camera.dist.end(), [](double d) { return std::isfinite(d); });
  if (!is_finite) return "the camera's calibration is not finite";
  return std::nullopt;
}

Reason whyNot(const CObservation2DRangeScan& scan) {
  constexpr double kWidest = 400 * M_PI / 180;  // some lasers measure slightly more than a full turn
  if (!std::isfinite(scan.aperture)) return "the aperture is not finite";
  if (!(scan.aperture > 0) || scan.aperture > kWidest) return "the aperture is not between 0 and 400 deg";
  return std::nullopt;
}

Reason whyNot(const CObservation3DRangeScan& scan) {
  if (auto reason = whyNot(scan.cameraParams)) return reason;
  if (!scan.hasRangeImage) return std::nullopt;
  if (!std::isfinite(scan.rangeUnits) || !(scan.rangeUnits > 0)) return "the unit of depth is not positive";
  return std::nullopt;
}

Reason whyNot(const CObservationBearingRange& measurement) {
  for (const auto& one : measurement.sensedData) {
    if (!std::isfinite(one.range) || !std::isfinite(one.yaw) || !std::isfinite(one.pitch))
      return "one of the bearings or ranges is not finite";
    if (measurement.validCovariances && !isCovariance(one.covariance.asEigen())) return kNoCovariance;
  }
  return std::nullopt;
}

Reason whyNot(const CObservationOdometry& odometry) {
  const auto& pose = odometry.odometry;
  if (!std::isfinite(pose.x()) || !std::isfinite(pose.y()) || !std::isfinite(pose.phi()))
    return "the pose is not finite";
  return std::nullopt;
}

Reason whyNot(const CObservationRobotPose& pose) {
  if (!isPose(pose.pose.mean)) return "the pose is not valid";
  if (!isCovariance(pose.pose.cov.asEigen())) return kNoCovariance;
  return std::nullopt;
}

Reason whyNot(const obs::CObservationRelativeMotion& motion) {
  if (!isPose(motion.begin_from_end)) return "the motion is not valid";
  if (!isCovariance(motion.covariance)) return kNoCovariance;
  return std::nullopt;
}

bool isFinite(const geometry::Polygon3& polygon) {
  return std::all_of(polygon.vertices.begin(), polygon.vertices.end(), [](const auto& v) { return v.allFinite(); });
}

Reason whyNot(const obs::CObservationPlanes& found) {
  constexpr double kRounding = 1e-3;
  for (const auto& plane : found.planes) {
    const auto& [normal, distance] = plane.plane_in_sensor;
    if (!(std::abs(normal.norm() - 1) < kRounding) || !std::isfinite(distance))
      return "one of the planes has no unit normal or no finite distance";
    if (!plane.centroid.allFinite() || !isFinite(plane.outline) ||
        !std::all_of(plane.holes.begin(), plane.holes.end(), isFinite))
      return "one of the outlines is not finite";
    if (!isCovariance(plane.covariance)) return kNoCovariance;
  }
  return std::nullopt;
}

Reason whyNot(const obs::CObservationLaserLines& found) {
  for (const auto& line : found.lines) {
    const auto& [from, to] = line.segment_in_sensor;
    if (!from.allFinite() || !to.allFinite() || !std::isfinite(line.angle) || !std::isfinite(line.distance))
      return "one of the lines is not finite";
    if (!isCovariance(line.covariance)) return kNoCovariance;
  }
  return std::nullopt;
}

Reason whyNot(const obs::CObservationCommand& command) {
  if (!std::isfinite(command.expiry) || command.expiry < 0) return "the command's expiry is not a time";
  if (!command.motion.allFinite()) return "the command's motion is not finite";
  return std::nullopt;
}

// whyNot() of the observation as a `Class`; none if it is of another class.
template <class Class>
Reason whyNotAs(const CObservation& observation) {
  const auto* it = dynamic_cast<const Class*>(&observation);
  return it ? whyNot(*it) : std::nullopt;
}

}  // namespace

std::optional<std::string> whyUnusable(const CObservation& observation) {
  constexpr double kFarthest = 1000;  // [m] of a sensor from the base that carries it
  mrpt::poses::CPose3D base_from_sensor;
  observation.getSensorPose(base_from_sensor);
  if (!isPose(base_from_sensor)) return "the sensor pose is not valid";
  if (base_from_sensor.norm() > kFarthest) return "the sensor is more than 1 km from the base";
  for (const auto& reason :
       {whyNotAs<CObservation2DRangeScan>(observation), whyNotAs<CObservation3DRangeScan>(observation),
        whyNotAs<CObservationBearingRange>(observation), whyNotAs<CObservationOdometry>(observation),
        whyNotAs<CObservationRobotPose>(observation), whyNotAs<obs::CObservationRelativeMotion>(observation),
        whyNotAs<obs::CObservationPlanes>(observation), whyNotAs<obs::CObservationLaserLines>(observation),
        whyNotAs<obs::CObservationCommand>(observation)}) {
    if (reason) return reason;
  }
  if (const auto* image = dynamic_cast<const CObservationImage*>(&observation)) return whyNot(image->cameraParams);
  return std::nullopt;
}

}  // namespace omnimapper::source
