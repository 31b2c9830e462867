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

class OdometryPluginFactory : public mapper::PosePluginFactory {
  DEFINE_MRPT_OBJECT(OdometryPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "OdometryPlugin"; }
  std::string summary() const override {
    return "Links key frames by wheel odometry, which the log holds as cumulative poses or as MRPT's actions.";
  }
  const std::vector<base::OptionSpec>& options() const override { return OdometryOptions::table().specs(); }
  std::unique_ptr<mapper::PosePlugin> make(const base::ConfigSection& section,
                                           const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
