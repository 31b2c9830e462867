#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/motion/PoseTimeline.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <map>
#include <optional>
#include <string>

namespace omnimapper::motion {

struct WheelOdometryOptions {
  std::string label;                                                         ///< empty: the first odometry's label
  double position_noise_per_root_m = 0.05;                                   ///< [m / sqrt(m)]
  double yaw_noise_per_root_turn = 0.06;                                     ///< [rad / sqrt(rad)]
  double yaw_noise_per_root_m = 2.0 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double position_noise_per_root_s = 0.002;                                  ///< [m / sqrt(s)]
  double yaw_noise_per_root_s = 0.1 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(s)]
  bool use_reported_covariance = false;

  /// Adds the keys of this struct to the table of a struct that derives from it.
  template <class Options>
  static base::OptionTable<Options>& declareIn(base::OptionTable<Options>& table);
};

/// The motion of the base as wheel odometry measured it (thesis 5.3.4.1): CObservationOdometry (cumulative poses) and
/// CObservationRelativeMotion (MRPT's actions). Variances grow linearly with distance travelled, turn and time, so that
/// spans add up.
class WheelOdometry {
 public:
  explicit WheelOdometry(const WheelOdometryOptions& options) : options_(options) {}

  enum class Taken {
    not_mine,  ///< of another kind or sensor
    taken,
    unusable,  ///< not finite, or its time runs backwards
  };
  struct Span {
    base::Stamp begin, end;
  };
  /// Takes an observation into the history if it is of the right kind and sensor. Observations may arrive in another
  /// order than that of their stamps.
  Taken add(const mrpt::obs::CObservation& observation);
  /// Motion from `begin` to `end` (begin <= end); none if the span is not covered. Spans add up as in PoseTimeline.
  std::optional<RelativeMotion> between(base::Stamp begin, base::Stamp end) const;
  std::optional<base::Stamp> coveredUntil() const { return timeline_.end(); }
  /// The time span for which the last add() brought new information; none if it brought none.
  std::optional<Span> news() const { return news_; }
  /// Warnings for the user at the end of a run: sentences that name the remedy.
  std::vector<std::string> warnings() const;
  /// Drops the data before `stamp`: earlier spans will not be requested any more.
  void forgetBefore(base::Stamp stamp);

 private:
  Taken addMotion(const obs::CObservationRelativeMotion& motion);
  Taken addPose(const mrpt::obs::CObservationOdometry& odometry);
  Taken addLatePose(base::Stamp stamp, const mrpt::poses::CPose3D& odom_from_base);
  void insertMotion(base::Stamp begin, base::Stamp end, const mrpt::poses::CPose3D& motion);
  bool isUnconfirmedLeap(base::Stamp stamp);
  bool isImpossible(const mrpt::poses::CPose3D& motion, double seconds);
  bool isOurs(const mrpt::obs::CObservation& observation);
  Eigen::Matrix<double, 6, 6> covarianceOf(const mrpt::poses::CPose3D& motion, double seconds) const;

  WheelOdometryOptions options_;
  std::optional<std::string> label_;                      // of the first odometry that came
  std::map<base::Stamp, mrpt::poses::CPose3D> readings_;  // odom_from_base
  std::optional<base::Stamp> leap_;                       // stamp of a reading far ahead of all before it
  std::optional<Span> news_;
  bool forgotten_ = false;      // readings before the first one of readings_ were dropped
  std::size_t impossible_ = 0;  // number of motions that no base can make; they are left out
  double farthest_ = 0;         // [m] length of the longest of these motions
  PoseTimeline timeline_;
};

template <class Options>
base::OptionTable<Options>& WheelOdometryOptions::declareIn(base::OptionTable<Options>& table) {
  const auto zero_or_more = base::Range::notNegative();
  return table.text("label", &Options::label, "Sensor label of the odometry; empty for the first odometry in the log.")
      .number("position_noise_per_root_m", &Options::position_noise_per_root_m, zero_or_more,
              "Standard deviation of the position after 1 m of distance travelled [m]; it grows with the square root "
              "of the distance.")
      .number(
          "yaw_noise_per_root_turn", &Options::yaw_noise_per_root_turn, zero_or_more,
          "Standard deviation of the heading after 1 rad of turning [rad]; it grows with the square root of the angle.")
      .number("yaw_noise_per_root_m_deg", &Options::yaw_noise_per_root_m, zero_or_more,
              "Standard deviation of the heading after 1 m of distance travelled; it grows with the square root of the "
              "distance.")
      .number("position_noise_per_root_s", &Options::position_noise_per_root_s, zero_or_more,
              "Standard deviation of the position after 1 s [m]; it grows with the square root of the time.")
      .number("yaw_noise_per_root_s_deg", &Options::yaw_noise_per_root_s, zero_or_more,
              "Standard deviation of the heading after 1 s; it grows with the square root of the time.")
      .flag("use_reported_covariance", &Options::use_reported_covariance,
            "Uses the covariance that MRPT's actions carry in place of the one that is computed from the "
            "..._noise_per_root_... keys of this section.");
}

}  // namespace omnimapper::motion
