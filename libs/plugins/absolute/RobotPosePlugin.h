#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct RobotPoseOptions {
  std::string label;  ///< empty: every CObservationRobotPose
  bool reference_is_map = true;
  double position_sigma = 0.02;                                     ///< [m]
  double angle_sigma = 1.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double loss_scale = 0;                                            ///< [sigma] of the Cauchy loss; 0: none

  static const base::OptionTable<RobotPoseOptions>& table();
};

/// External absolute poses (CObservationRobotPose), such as those of motion capture (thesis 5.2.2.2). They are trusted:
/// unless loss_scale is set, they have no robust loss, so that no other measurement overrules them beyond what their
/// covariance allows. Each pose is that of a tracked body, and the observation's sensorPose is the pose of this body on
/// the base. The poses are given in the map frame, or in a reference frame whose pose in the map is a variable.
class RobotPosePlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "RobotPosePlugin";
  static constexpr const char* kSummary =
      "Absolute poses that are given in the log (CObservationRobotPose), for example by motion capture.";

  RobotPosePlugin(const RobotPoseOptions& options, const mapper::PluginContext& context)
      : options_(options), context_(context) {}

  bool wants(const mrpt::obs::CObservation& observation) const override;
  bool givesAbsolutePoses() const override { return options_.reference_is_map; }
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override;
  /// Saves the variable map_from_reference.
  std::optional<map::MapSection> save() const override;
  void restore(const map::MapSection* saved, const mapper::View& view) override;
  /// The largest deviation of the map from the given poses.
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;

 private:
  struct Given {
    base::KeyFrameId frame;
    mrpt::poses::CPose3D reference_from_base;
    Eigen::Matrix<double, 6, 6> covariance;  // in the tangent at the pose
  };
  RobotPoseOptions options_;
  mapper::PluginContext context_;
  std::optional<base::VariableId> map_from_reference_;
  std::vector<Given> given_;  // of this session
};

}  // namespace omnimapper::plugins
