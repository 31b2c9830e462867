#pragma once

#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/motion/PoseTimeline.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace omnimapper::motion {

struct GyroscopeOptions {
  std::string label;                                                     ///< empty: the first gyroscope's label
  double noise_per_root_s = 0.1 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(s)]
  double bias_sigma = 1 * base::option_text::kRadiansPerDegree;  ///< [rad/s] standard deviation of the initial bias
};

/// A measured rotation with its uncertainty.
struct Turn {
  Eigen::Quaterniond begin_from_end;  ///< of the base
  Eigen::Matrix3d covariance;         ///< of a rotation vector in the base at the end [rad^2]
};

/// The rotation of the base, integrated from an inertial sensor's turn rates (CObservationIMU with WX, WY, WZ in the
/// sensor's frame [rad/s]), which are interpolated linearly between readings. The bias, the rate that the sensor shows
/// at rest, is learnt from turns that other sensors measured.
class Gyroscope {
 public:
  explicit Gyroscope(const GyroscopeOptions& options)
      : options_(options), bias_variance_(variance(options.bias_sigma)) {}

  /// Takes an observation into the history if it has finite turn rates, comes from the one sensor that is used, and is
  /// newer than the last reading. True if it was taken.
  bool add(const mrpt::obs::CObservation& observation);
  /// Rotation of the base from `begin` to `end` (begin <= end); none where readings are missing for longer than 0.1 s.
  std::optional<Turn> between(base::Stamp begin, base::Stamp end) const;
  std::optional<base::Stamp> coveredUntil() const { return timeline_.end(); }
  /// Learns the bias from a turn of the base that another sensor measured, with a standard deviation of `sigma` [rad]
  /// about each axis. A turn that differs from the expected one by more than both uncertainties allow is ignored.
  void learn(base::Stamp begin, base::Stamp end, const Eigen::Quaterniond& begin_from_end, double sigma);
  /// The rate that the sensor shows at rest [rad/s], in the base's frame.
  const Eigen::Vector3d& bias() const { return bias_; }
  /// Drops the data before `stamp`: earlier spans will not be requested any more.
  void forgetBefore(base::Stamp stamp) { timeline_.forgetBefore(stamp); }

 private:
  struct Reading {
    base::Stamp stamp;
    Eigen::Vector3d rate;  // in the base's frame, bias included [rad/s]
  };
  static double variance(double sigma) { return sigma * sigma; }

  GyroscopeOptions options_;
  std::optional<std::string> label_;  // of the first gyroscope that sent data
  std::optional<Reading> last_;
  PoseTimeline timeline_;  // rotations with the bias included
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_variance_;               // of each axis [rad^2/s^2]
  std::optional<base::Stamp> learnt_;  // end of the last turn that was learnt from
};

}  // namespace omnimapper::motion
