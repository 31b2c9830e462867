#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct TrajectoryOptions {
  bool key_frames_only = false;

  static const base::OptionTable<TrajectoryOptions>& table();
};

/// Writes trajectory.tum: map_from_base at every observation of the reference sensor, one per line: "stamp x y z qx qy
/// qz qw" with Unix time [s] to the tick, lengths [m] and a unit quaternion, qw >= 0.
class TrajectoryOutput : public mapper::OutputPlugin {
 public:
  TrajectoryOutput(const TrajectoryOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  TrajectoryOptions options_;
  std::string path_;
};

class TrajectoryOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(TrajectoryOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "TrajectoryOutput"; }
  std::string summary() const override {
    return "Writes trajectory.tum, with one line for each observation of the reference sensor.";
  }
  const std::vector<base::OptionSpec>& options() const override { return TrajectoryOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
