#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Verdict.h>

#include <optional>

namespace omnimapper::mapper {

/// Evidence against a map with [mapper] motion = planar if the base, according to its pose plugins, often tilted
/// between consecutive key frames by more than ramps and thresholds tilt a robot, as a hand-held camera does. None
/// otherwise.
std::optional<Evidence> judgeTilt(const map::Map& map);

}  // namespace omnimapper::mapper
