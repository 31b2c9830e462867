#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/motion/PoseTimeline.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <map>
#include <optional>
#include <string>

namespace omnimapper::plugins {

struct GivenMotionOptions {
  std::string label;                                                ///< of the poses; empty: that of the first pose
  double max_gap = 1;                                               ///< [s] largest, from one pose to the next
  double position_sigma = 0.05;                                     ///< [m] after 1 s; grows with the root of time
  double angle_sigma = 2.0 * base::option_text::kRadiansPerDegree;  ///< [rad] after 1 s; grows with the root of time

  static const base::OptionTable<GivenMotionOptions>& table();
};

/// A continuous pose source (thesis 5.2.2.1) from external poses, such as those of motion capture
/// (CObservationRobotPose): it gives the motion from one pose to the next. It is meant to run beside a RobotPosePlugin,
/// which places the key frames by the same poses; this plugin places the observations between key frames. The noise of
/// its motions is wide, because the poses already count in RobotPosePlugin.
class GivenMotionPlugin : public mapper::PosePlugin {
 public:
  static constexpr const char* kName = "GivenMotionPlugin";
  static constexpr const char* kSummary =
      "The motion between poses that are given in the log (CObservationRobotPose), for example by motion capture.";

  explicit GivenMotionPlugin(const GivenMotionOptions& options) : options_(options) {}

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  std::optional<Span> news() const override { return news_; }
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  void forgetBefore(base::Stamp stamp) override;

 private:
  using Poses = std::map<base::Stamp, mrpt::poses::CPose3D>;
  void addMotion(const Poses::value_type& begin, const Poses::value_type& end);

  GivenMotionOptions options_;
  std::optional<std::string> label_;  // of the first pose that came
  Poses poses_;                       // reference_from_base
  bool forgotten_ = false;            // true: poses before the first of poses_ were dropped
  std::optional<Span> news_;
  motion::PoseTimeline timeline_;
};

}  // namespace omnimapper::plugins
