#pragma once

#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

#include "LevelEvidence.h"

namespace omnimapper::mapper {

/// A level with what a user should know of it.
struct JudgedLevel {
  map::Level level;
  std::vector<std::string> warnings;  ///< sentences
};

/// Which way is up in a map: by gravity where an inertial sensor told it; else by the landmarks that are flat; else by
/// the base of a robot on wheels. In a planar map of such a robot z is up, for the base is level by assumption, unless
/// gravity or surfaces clearly contradict. What an earlier session knew by gravity counts on where this one has no
/// inertial sensor.
JudgedLevel estimateLevel(const State& state, const LevelEvidence& evidence, Motion motion);

}  // namespace omnimapper::mapper
