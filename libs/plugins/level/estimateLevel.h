#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

#include "LevelEvidence.h"

namespace omnimapper::plugins {

struct LevelOptions {
  /// [rad] Standard deviation of the tilt of floors and of the chassis of robots on wheels.
  double base_sigma = 1 * base::option_text::kRadiansPerDegree;

  static const base::OptionTable<LevelOptions>& table();
};

/// A level and the warnings about it.
struct JudgedLevel {
  map::Level level;
  std::vector<std::string> warnings;  ///< sentences
};

/// Determines which way is up in a map: by gravity if an inertial sensor measured it, else by the flat landmarks, else
/// by the base of a robot on wheels. In a planar map the base is level by assumption and z is up, unless gravity or
/// surfaces clearly contradict. If this session has no inertial sensor, the gravity of an earlier session is used.
JudgedLevel estimateLevel(const mapper::State& state, const LevelEvidence& evidence, mapper::Motion motion,
                          const LevelOptions& options = {});

}  // namespace omnimapper::plugins
