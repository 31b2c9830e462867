#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/matching/PoseTimeline.h>
#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct VisualOdometryOptions {
  std::string label;              ///< of the camera; empty: the first that comes
  double max_speed = 1.5;         ///< [m/s] of a camera; what seems faster is an error
  double position_noise = 0.001;  ///< [m] between two images
  double angle_noise = 0.05 * base::option_text::kRadiansPerDegree;            ///< [rad] between two images
  double position_noise_per_root_m = 0.01;                                     ///< [m / sqrt(m)]
  double position_noise_per_root_turn = 0.01;                                  ///< [m / sqrt(rad)]
  double angle_noise_per_root_m = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double angle_noise_per_root_turn = 0.013;                                    ///< [rad / sqrt(rad)]

  static const base::OptionTable<VisualOdometryOptions>& table();
};

/// Visual odometry as a continuous pose source (thesis 5.3.4.2): every image of one depth camera is registered with a
/// key frame of before (matching/RgbdTracker.h), in the order of stamps. One that comes after its time was worked on is
/// left out. A lens that is covered, a view that shows nothing: then the motion is not told until the view is found
/// again, and it is told across the gap; after a long gap the camera begins anew, and what happened meanwhile is left
/// to others.
class VisualOdometryPlugin : public mapper::PosePlugin {
 public:
  VisualOdometryPlugin(const VisualOdometryOptions& options, const matching::RgbdTrackerOptions& tracking,
                       const matching::DenseMatcherOptions& matching);

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  void processUntil(base::Stamp stamp) override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  std::vector<std::string> warnings() const override;
  /// Gaps across which the camera did not tell the motion, how much of the time it was lost or saw too
  /// little, speeds that cannot be, and how often it came back
  /// to a view of before, where what drifts would be seen.
  std::vector<mapper::Evidence> evidence() const override;
  void forgetBefore(base::Stamp stamp) override { timeline_.forgetBefore(stamp); }

 private:
  void follow(const mrpt::obs::CObservation3DRangeScan& scan);
  mapper::RelativeMotion motionOf(const matching::RgbdTracker::Tracked& tracked, base::Stamp stamp,
                                  const mrpt::poses::CPose3D& base_from_sensor) const;

  VisualOdometryOptions options_;
  matching::RgbdTracker tracker_;
  std::optional<std::string> label_;                                          // of the first that came
  std::map<base::Stamp, mrpt::obs::CObservation3DRangeScan::ConstPtr> wait_;  // for their time
  std::optional<base::Stamp> reached_, begun_;  // image that was worked on last, first image of all
  std::size_t images_ = 0, lost_ = 0, gaps_ = 0, returns_ = 0, bridged_ = 0, hasty_in_a_row_ = 0, runaways_ = 0,
              unreadable_ = 0;
  bool has_begun_ = false;
  double first_gap_ = 0;        // [s] after the first image
  std::string why_unreadable_;  // of the first image that was
  matching::PoseTimeline timeline_;
};

class VisualOdometryPluginFactory : public mapper::PosePluginFactory {
  DEFINE_MRPT_OBJECT(VisualOdometryPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "VisualOdometryPlugin"; }
  std::string summary() const override {
    return "Visual odometry: every depth image and its picture against key frames.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::PosePlugin> make(const base::ConfigSection& section,
                                           const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
