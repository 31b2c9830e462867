#pragma once

#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

#include "LevelEvidence.h"

namespace omnimapper::mapper {

/// A level and the warnings about it.
struct JudgedLevel {
  map::Level level;
  std::vector<std::string> warnings;  ///< sentences
};

/// Determines which way is up in a map: by gravity if an inertial sensor measured it, else by the flat landmarks, else
/// by the base of a robot on wheels. In a planar map the base is level by assumption and z is up, unless gravity or
/// surfaces clearly contradict. If this session has no inertial sensor, the gravity of an earlier session is used.
JudgedLevel estimateLevel(const State& state, const LevelEvidence& evidence, Motion motion);

}  // namespace omnimapper::mapper
