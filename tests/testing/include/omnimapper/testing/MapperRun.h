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

// An engine to which a test adds observations by hand, and its results. For test binaries that link omnimapper-engine
// and the features that their INIs name.
namespace omnimapper::testing {

/// Laser and wheel odometry, the null motion model and loop closures as in ini/laser2d.ini, without outputs.
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
  auto plugins = mapper::makePlugins(
      {options.pose_plugins, perception.extractors, mapper::measurementSections(config), {}}, config, context);
  return std::make_unique<mapper::Engine>(options_of_engine, "test", mapper::SensorPoses(options.sensors, config),
                                          std::move(plugins), threads);
}

/// Adds all observations in this order and finishes the run.
inline void run(mapper::Engine& engine, const std::vector<mrpt::obs::CObservation::Ptr>& observations) {
  for (const auto& observation : observations) engine.add(observation);
  engine.finish();
}

/// All bytes of graph and map, for comparing two runs bit by bit.
inline std::string bitsOf(const mapper::View& view) {
  std::ostringstream bits;
  graph::writeGraph(view.graph, bits);
  return bits.str() + map::framesToSection(view.map).bytes;
}

/// Root mean square distance [m] of the whole trajectory from the truth, both relative to the first key frame.
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
