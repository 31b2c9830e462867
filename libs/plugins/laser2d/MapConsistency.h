#pragma once

#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// How much of what is `seen` lies on the points of a map [0, 1]: a mean likelihood, 0 without either. In one frame.
double shareOnWalls(const std::vector<Eigen::Vector2f>& map, const std::vector<Eigen::Vector2f>& seen);

/// How many of the 2D scans have many beams that pass through walls that the map itself has: those of a stretch that
/// lies where it should not. `labels`: of the clouds that these scans became, as in the key frames.
mapper::Evidence scansThroughWalls(const map::Map& map, const std::vector<std::string>& labels);

/// How far the robot drove where it had been before, after at least `min_travel` [m], and how much of that no closure
/// of the plugin `section` ties to what was seen there and where the scans do not fit what was seen there either. Last
/// comes how much of the way lies between two visits of a place: the rest may be bent without anybody seeing it.
/// `labels` as above.
std::vector<mapper::Evidence> revisits(const mapper::State& state, const std::string& section,
                                       const std::vector<std::string>& labels, double min_travel);

/// Where spans of the trajectory slipped and were corrected, and whether closures that agree with one another,
/// newer than all that act, contradict the map: what SlipSearch decided. `decisions`: of this run.
std::vector<mapper::Evidence> slips(const mapper::State& state, const std::string& section,
                                    const mapper::DecisionLog& decisions);

}  // namespace omnimapper::plugins
