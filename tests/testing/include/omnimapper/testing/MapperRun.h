#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "Engine.h"

// For test binaries that link omnimapper-engine, and features that their INIs name: an engine to feed by hand, and what
// came out of it.
namespace omnimapper::testing {

/// Laser and wheel odometry, the null motion model and loop closures, as ini/laser2d.ini has them, without outputs.
inline const std::string kLaserIni = R"(
[mapper]
pose_plugins        = scan_odometry, odometry, no_motion
measurement_plugins = loop_closure
[perception]
extractors = laser_points
[scan_odometry]
class = ScanOdometryPlugin
[odometry]
class = OdometryPlugin
fallback = true
[no_motion]
class = NoMotionPlugin
[laser_points]
class = LaserPointsExtractor
[loop_closure]
class = LoopClosurePlugin
)";

/// An engine made from the text of an INI as runMapping() makes it; `settings` are "section.key=value".
inline std::unique_ptr<mapper::Engine> makeEngine(const std::string& ini, const std::vector<std::string>& settings = {},
                                                  int threads = 1, bool map_is_held = false) {
  mapper::loadFeatures();
  auto config = base::Config::fromText(ini, "test.ini");
  for (const auto& setting : settings) config.set(setting);
  const auto options_of_engine = mapper::EngineSettings::read(config);
  const auto& options = options_of_engine.engine;
  const auto perception = config.section("perception").read<mapper::PerceptionOptions>();
  mapper::PluginContext context;
  context.motion = options.motion;
  context.map_is_held = map_is_held;
  context.config_text = config.text();
  auto plugins = mapper::makePlugins({options.pose_plugins, perception.extractors, options.measurement_plugins, {}},
                                     config, context);
  return std::make_unique<mapper::Engine>(options_of_engine, "test", mapper::SensorPoses(options.sensors, config),
                                          std::move(plugins), threads);
}

/// Feeds it all observations in that order, to the end.
inline void run(mapper::Engine& engine, const std::vector<mrpt::obs::CObservation::Ptr>& observations) {
  for (const auto& observation : observations) engine.add(observation);
  engine.finish();
}

/// Every bit of graph and map, to compare two runs.
inline std::string bitsOf(const mapper::View& view) {
  std::ostringstream bits;
  graph::writeGraph(view.graph, bits);
  return bits.str() + map::framesToSection(view.map).bytes;
}

/// Root mean square distance [m] of the whole trajectory from the truth, both seen from the first key frame.
inline double trajectoryError(const mapper::View& view, const SimulatedLog& log) {
  const auto trajectory = map::denseTrajectory(view.map);
  double sum = 0;
  for (const auto& pose : trajectory) {
    const mrpt::poses::CPose3D truth(log.truthAt(pose.stamp) - log.truthAt(trajectory.front().stamp));
    sum += (truth.translation() - pose.map_from_base.translation()).sqrNorm();
  }
  return std::sqrt(sum / static_cast<double>(trajectory.size()));
}

}  // namespace omnimapper::testing
