#pragma once

#include <omnimapper/sim/Simulation.h>

#include <cmath>
#include <string>

#include "RawlogFrames.h"

namespace omnimapper::bench {

/// A random unit vector; all directions are equally likely.
inline Eigen::Vector3d anyDirection(sim::Random& random) {
  const double x = random.gaussian(), y = random.gaussian();
  return Eigen::Vector3d(x, y, random.gaussian()).normalized();
}

/// A random motion of 2 to 3 cm and 1 to 2 deg, both in random directions.
inline geometry::Se3 smallMotion(sim::Random& random) {
  const Eigen::Vector3d translation = random.uniform(0.02, 0.03) * anyDirection(random);
  const double angle = random.uniform(1, 2) * M_PI / 180;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, anyDirection(random))), translation};
}

/// Adds two images of the first camera in a simulated place of this seed: one from a random pose of the drive, one
/// after a small motion from there. The camera does not move during an exposure. Each seed gives another place.
inline void addSimulatedPair(base::Config config, std::uint64_t seed, PosedFrames& posed) {
  config.set("simulation.seed=" + std::to_string(seed));
  config.set("world.seed=" + std::to_string(seed));
  const sim::Simulation simulation(config);
  sim::Random random(seed, {});
  const auto map_from_base = *simulation.mapFromBase().at(random.uniform(0, simulation.duration()));
  const sim::Track track(sim::Track::Kind::steps, {{0, map_from_base}, {0.5, map_from_base * smallMotion(random)}});
  sim::SensorContext context;
  context.seed = seed;
  context.start = simulation.start();
  context.duration = 1;
  context.world = &simulation.world();
  context.scenes = &simulation.scenes();
  context.map_from_base = &track;
  const auto camera = sim::makeSensor(config, simulation.options().sensors.front(), context);
  for (const int k : {0, camera->count() - 1}) {
    const auto measurement = camera->measure(k);
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
    posed.frames.push_back(frameOf(scan));
    posed.poses.push_back(*track.at(camera->timeOf(k)) * geometry::fromMrpt(scan.sensorPose) *
                          geometry::sensorFromOptical());
  }
}

/// Pairs of images with exact poses: images 2 i and 2 i + 1 are the pair of seed i + 1.
inline PosedFrames simulatedPairs(const std::string& ini, int pairs) {
  const auto config = base::Config::fromFile(ini);
  PosedFrames posed;
  for (int i = 0; i < pairs; ++i) addSimulatedPair(config, static_cast<std::uint64_t>(i) + 1, posed);
  return posed;
}

}  // namespace omnimapper::bench
