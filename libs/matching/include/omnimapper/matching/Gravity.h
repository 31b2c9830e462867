#pragma once

#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::matching {

/// The mean specific force over half a second in which the base hardly turned.
struct SteadySpan {
  base::Stamp stamp;      ///< its middle
  Eigen::Vector3d force;  ///< in the base's frame, in the unit that the sensor tells; at rest it points up
  double scatter = 0;     ///< root mean square of the readings about it, in that unit
};

/// Collects the spans of one inertial sensor (CObservationIMU with X_ACC, Y_ACC, Z_ACC in the sensor's frame) in which
/// gravity can be told from turning. Readings that are not finite, or come out of order, are left out.
class SteadySpans {
 public:
  /// True if it tells a finite acceleration.
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

/// A span at the rotation that the base had then.
struct RotatedSpan {
  Eigen::Quaterniond map_from_base;
  SteadySpan span;
};

/// Which way is up by gravity.
struct Gravity {
  std::optional<Eigen::Vector3d> up;  ///< unit, in the map; none where the accelerations do not tell
  /// Of the rotation vector in the map that takes the true up to `up` [rad^2].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double magnitude = 0;  ///< [m/s^2] median
  std::string reason;    ///< half a sentence, in both cases
};

/// Least squares with Cauchy's loss for gravity in the map and the sensor's constant bias, which only a base that turns
/// tells apart: the bias has a standard deviation of 0.1 m/s^2 beforehand, 0.6 deg. Accelerations in g are taken for
/// such. None where there are fewer than four spans, or where the accelerations are not those of gravity.
Gravity gravityOf(const std::vector<RotatedSpan>& spans);

}  // namespace omnimapper::matching
