#pragma once

#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Share of the points `seen` that lie on the points of a map [0, 1], as a mean likelihood; 0 if either is empty. All
/// are in one frame.
double shareOnWalls(const std::vector<Eigen::Vector2f>& map, const std::vector<Eigen::Vector2f>& seen);

/// Share of the 2D scans that have many beams through walls of the map, as where a stretch of the trajectory is wrong.
/// `labels`: of the clouds that were made from these scans, as in the key frames.
mapper::Evidence scansThroughWalls(const map::Map& map, const std::vector<std::string>& labels);

/// Distance driven where the robot had been before, at least `min_travel` [m] of travel earlier; how much of it is
/// unconfirmed, because no closure of the plugin `section` ties it to the earlier visit and the scans do not fit what
/// was seen then; and the share of the travel that lies between two visits of a place: errors in the rest would go
/// unnoticed. `labels` as above.
std::vector<mapper::Evidence> revisits(const mapper::State& state, const std::string& section,
                                       const std::vector<std::string>& labels, double min_travel);

/// The results of SlipSearch: slips that were corrected, and whether closures that agree with one another contradict
/// the map and no later accepted closure resolves that. `decisions`: of this run.
std::vector<mapper::Evidence> slips(const mapper::State& state, const std::string& section,
                                    const mapper::DecisionLog& decisions);

}  // namespace omnimapper::plugins
