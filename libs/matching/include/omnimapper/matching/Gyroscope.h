#pragma once

#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/matching/PoseTimeline.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace omnimapper::matching {

struct GyroscopeOptions {
  std::string label;                                                     ///< empty: the first that comes
  double noise_per_root_s = 0.1 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(s)]
  double bias_sigma = 1 * base::option_text::kRadiansPerDegree;          ///< [rad/s] before it was learnt
};

/// How a rotation was told, with what it may be off by.
struct Turn {
  Eigen::Quaterniond begin_from_end;  ///< of the base
  Eigen::Matrix3d covariance;         ///< of a rotation vector in the base at the end [rad^2]
};

/// The turning of the base as an inertial sensor's rates tell it (CObservationIMU with WX, WY, WZ in the sensor's frame
/// [rad/s]): rates go evenly from reading to reading. What a gyroscope shows at rest, its bias, is learnt from turns
/// that others measured.
class Gyroscope {
 public:
  explicit Gyroscope(const GyroscopeOptions& options)
      : options_(options), bias_variance_(variance(options.bias_sigma)) {}

  /// Takes an observation into the history if it tells finite turn rates of the one sensor and comes in the order of
  /// stamps. True if it did.
  bool add(const mrpt::obs::CObservation& observation);
  /// Of the base from `begin` to `end` (begin <= end); none where readings are missing for longer than 0.1 s.
  std::optional<Turn> between(base::Stamp begin, base::Stamp end) const;
  std::optional<base::Stamp> coveredUntil() const { return timeline_.end(); }
  /// The base turned like that, with a standard deviation of `sigma` [rad] about each axis. What is farther from what
  /// is known of the bias than both can be off by is left out.
  void learn(base::Stamp begin, base::Stamp end, const Eigen::Quaterniond& begin_from_end, double sigma);
  /// What it shows at rest [rad/s], in the base's frame.
  const Eigen::Vector3d& bias() const { return bias_; }
  /// Spans before `stamp` will not be asked for any more.
  void forgetBefore(base::Stamp stamp) { timeline_.forgetBefore(stamp); }

 private:
  struct Reading {
    base::Stamp stamp;
    Eigen::Vector3d rate;  // in the base's frame, with its bias [rad/s]
  };
  static double variance(double sigma) { return sigma * sigma; }

  GyroscopeOptions options_;
  std::optional<std::string> label_;  // of the first that came
  std::optional<Reading> last_;
  PoseTimeline timeline_;  // with the bias
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_variance_;               // of each axis
  std::optional<base::Stamp> learnt_;  // until when
};

}  // namespace omnimapper::matching
