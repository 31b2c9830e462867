#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

struct NoMotionOptions {
  double position_sigma = 0.5;                                       ///< [m] after 1 s; grows with the root of time
  double angle_sigma = 45.0 * base::option_text::kRadiansPerDegree;  ///< [rad] after 1 s; grows with the root of time

  static const base::OptionTable<NoMotionOptions>& table();
};

/// The null motion model (thesis 5.3.4.3): the robot probably stayed where it was. Keeps the trajectory connected where
/// no other source measures the motion.
class NoMotionPlugin : public mapper::PosePlugin {
 public:
  static constexpr const char* kName = "NoMotionPlugin";
  static constexpr const char* kSummary =
      "Assumes, with a large uncertainty, that the base did not move where no odometry measures its motion.";

  explicit NoMotionPlugin(const NoMotionOptions& options) : options_(options) {}

  Taken add(const mrpt::obs::CObservation::ConstPtr&) override { return Taken::not_mine; }
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override;
  std::optional<base::Stamp> coveredUntil() const override { return std::nullopt; }
  bool isFallback() const override { return true; }
  bool measures() const override { return false; }

 private:
  NoMotionOptions options_;
};

}  // namespace omnimapper::plugins
