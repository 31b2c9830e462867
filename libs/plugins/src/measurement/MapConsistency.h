#pragma once

#include <omnimapper/mapper/Verdict.h>
#include <omnimapper/mapper/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// How many of the 2D scans have many beams that pass through walls that the map itself has: those of a stretch that
/// lies where it should not. `labels`: of the clouds that these scans became, as in the key frames.
mapper::Evidence scansThroughWalls(const map::Map& map, const std::vector<std::string>& labels);

/// Whether the robot came back to places where it had been, at least `min_way` [m] of travel before, and how much of
/// that was tied to what it had seen there: by the closures of `section`.
std::vector<mapper::Evidence> revisits(const mapper::View& view, const std::string& section, double min_way);

}  // namespace omnimapper::plugins
