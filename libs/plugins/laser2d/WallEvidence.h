#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Verdict.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// What contradicts the walls of the map. First the share of the 2D scans in which many beams pass through walls, which
/// happens where a stretch of the trajectory is wrong. Then the number of times that the track of the base leads
/// through a wall, which no robot drives through. `labels`: those of the clouds that were made from the scans.
std::vector<mapper::Evidence> throughWalls(const map::Map& map, const std::vector<std::string>& labels);

}  // namespace omnimapper::plugins
