#pragma once

#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::motion {

/// The mean specific force over half a second in which the base hardly turned.
struct SteadySpan {
  base::Stamp stamp;      ///< middle of the span
  Eigen::Vector3d force;  ///< in the base's frame, in the unit of the sensor; at rest it points up
  double scatter = 0;     ///< root mean square deviation of the readings from `force`, in the same unit
};

/// Collects the spans of one inertial sensor (CObservationIMU with X_ACC, Y_ACC, Z_ACC in the sensor's frame) in which
/// turning does not disturb the measurement of gravity. Readings that are not finite, or come out of order, are left
/// out.
class SteadySpans {
 public:
  /// True if the reading has a finite acceleration.
  bool add(const mrpt::obs::CObservationIMU& imu);
  const std::vector<SteadySpan>& all() const { return spans_; }

 private:
  struct Sum {
    base::Stamp begin, end;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), first_half = Eigen::Vector3d::Zero();
    double squares = 0, turning = 0;
    std::size_t readings = 0, of_first_half = 0, rates = 0;
  };
  void close();

  std::optional<Sum> sum_;
  std::vector<SteadySpan> spans_;
};

/// A span with the rotation of the base at that time.
struct RotatedSpan {
  Eigen::Quaterniond map_from_base;
  SteadySpan span;
};

/// The direction of up, measured by gravity.
struct Gravity {
  std::optional<Eigen::Vector3d> up;  ///< unit, in the map; none where the accelerations do not determine it
  /// Covariance [rad^2] of the error of `up`, as a rotation vector in the map that turns the true up direction into
  /// `up`.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double magnitude = 0;  ///< [m/s^2] median
  std::string reason;    ///< half a sentence, also if there is a result
};

/// Estimates gravity in the map and the sensor's constant bias by least squares with Cauchy's loss. The two can be told
/// apart only if the base turns, so the bias has a prior with a standard deviation of 0.1 m/s^2, which corresponds to
/// 0.6 deg of tilt. Accelerations in g are recognized. `up` is none if there are fewer than four spans, or if the
/// accelerations are not those of gravity.
Gravity gravityOf(const std::vector<RotatedSpan>& spans);

}  // namespace omnimapper::motion
