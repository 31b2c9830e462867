#include "TrajectoryOutput.h"

#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/map/DenseTrajectory.h>

namespace omnimapper::plugins {

const base::OptionTable<TrajectoryOptions>& TrajectoryOptions::table() {
  static const auto table =
      base::OptionTable<TrajectoryOptions>().flag("key_frames_only", &TrajectoryOptions::key_frames_only,
                                                  "Writes the key frames only, without the observations between them.");
  return table;
}

TrajectoryOutput::TrajectoryOutput(const TrajectoryOptions& options, const mapper::PluginContext& context)
    : options_(options), path_(derived::outputPath(context, "trajectory.tum")) {}

void TrajectoryOutput::finish(const mapper::View& view) {
  std::vector<map::StampedPose> trajectory;
  if (options_.key_frames_only) {
    for (const auto& frame : view.map.key_frames) {
      if (view.map_is_held && frame.id.session != view.map.sessions.back().number) continue;
      trajectory.push_back({frame.stamp, frame.map_from_base, frame.id.session});
    }
  } else {
    trajectory = derived::trajectoryOf(view);
  }
  std::string text;
  for (const auto& pose : trajectory) text += geometry::tumLine(pose.stamp, geometry::fromMrpt(pose.map_from_base));
  derived::writeBytes(path_, text);
}

}  // namespace omnimapper::plugins
