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
  static constexpr const char* kName = "TrajectoryOutput";
  static constexpr const char* kSummary =
      "Writes trajectory.tum, with one line for each observation of the reference sensor.";

  TrajectoryOutput(const TrajectoryOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  TrajectoryOptions options_;
  std::string path_;
};

}  // namespace omnimapper::plugins
