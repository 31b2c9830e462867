#pragma once

#include <omnimapper/motion/WheelOdometry.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

struct OdometryOptions : motion::WheelOdometryOptions {
  bool fallback = false;  ///< used only where no other source measures the motion

  static const base::OptionTable<OdometryOptions>& table();
};

/// motion::WheelOdometry as a continuous pose source.
class OdometryPlugin : public mapper::PosePlugin {
 public:
  static constexpr const char* kName = "OdometryPlugin";
  static constexpr const char* kSummary =
      "Links key frames by wheel odometry, which the log holds as cumulative poses or as MRPT's actions.";

  explicit OdometryPlugin(const OdometryOptions& options) : odometry_(options), is_fallback_(options.fallback) {}

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return odometry_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override { return odometry_.coveredUntil(); }
  std::optional<Span> news() const override;
  bool isFallback() const override { return is_fallback_; }
  std::vector<std::string> warnings() const override { return odometry_.warnings(); }
  void forgetBefore(base::Stamp stamp) override { odometry_.forgetBefore(stamp); }

 private:
  motion::WheelOdometry odometry_;
  bool is_fallback_;
};

}  // namespace omnimapper::plugins
