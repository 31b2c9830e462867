#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/PoseTimeline.h>

#include <map>
#include <optional>
#include <string>

namespace omnimapper::plugins {

struct OdometryOptions {
  std::string label;                                                         ///< empty: the first that comes
  double position_noise_per_root_m = 0.05;                                   ///< [m / sqrt(m)]
  double yaw_noise_per_root_turn = 0.06;                                     ///< [rad / sqrt(rad)]
  double yaw_noise_per_root_m = 2.0 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double position_noise_per_root_s = 0.002;                                  ///< [m / sqrt(s)]
  double yaw_noise_per_root_s = 0.1 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(s)]
  bool use_reported_covariance = false;
  bool fallback = false;  ///< only where no other source tells the motion

  static const base::OptionTable<OdometryOptions>& table();
};

/// Wheel odometry as a continuous pose source (thesis 5.3.4.1): CObservationOdometry (cumulative poses) and
/// CObservationRelativeMotion (MRPT's actions). Variances grow evenly with way, turn and time, so that spans add up.
class OdometryPlugin : public mapper::PosePlugin {
 public:
  explicit OdometryPlugin(const OdometryOptions& options) : options_(options) {}

  Taken add(const mrpt::obs::CObservation& observation) override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override;
  std::optional<base::Stamp> coveredUntil() const override { return timeline_.end(); }
  std::optional<Span> news() const override { return news_; }
  bool isFallback() const override { return options_.fallback; }
  std::vector<std::string> warnings() const override;
  void forgetBefore(base::Stamp stamp) override;

 private:
  Taken addMotion(const obs::CObservationRelativeMotion& motion);
  Taken addPose(const mrpt::obs::CObservationOdometry& odometry);
  Taken addLatePose(base::Stamp stamp, const mrpt::poses::CPose3D& odom_from_base);
  void tell(base::Stamp begin, base::Stamp end, const mrpt::poses::CPose3D& motion);
  bool isUnconfirmedLeap(base::Stamp stamp);
  bool isImpossible(const mrpt::poses::CPose3D& motion, double seconds);
  bool isOurs(const mrpt::obs::CObservation& observation);
  Eigen::Matrix<double, 6, 6> covarianceOf(const mrpt::poses::CPose3D& motion, double seconds) const;

  OdometryOptions options_;
  std::optional<std::string> label_;                      // of the first that came
  std::map<base::Stamp, mrpt::poses::CPose3D> readings_;  // odom_from_base
  std::optional<base::Stamp> leap_;                       // of a reading far ahead of all before it
  std::optional<Span> news_;
  bool forgotten_ = false;      // there were readings before the first
  std::size_t impossible_ = 0;  // motions that no base can make, and that are not told
  double farthest_ = 0;         // [m] of these
  mapper::PoseTimeline timeline_;
};

class OdometryPluginFactory : public mapper::PosePluginFactory {
  DEFINE_MRPT_OBJECT(OdometryPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "OdometryPlugin"; }
  std::string summary() const override { return "Wheel odometry, cumulative or as MRPT's actions, links key frames."; }
  const std::vector<base::OptionSpec>& options() const override { return OdometryOptions::table().specs(); }
  std::unique_ptr<mapper::PosePlugin> make(const base::ConfigSection& section,
                                           const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
