#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Verdict.h>

#include <optional>

namespace omnimapper::mapper {

/// Evidence against a map with [mapper] motion = planar whose base, by what its pose plugins told, often tilted from
/// one key frame to the next by more than ramps and thresholds tilt a robot: a hand carried it. None if it did not.
std::optional<Evidence> judgeTilt(const map::Map& map);

}  // namespace omnimapper::mapper
