#pragma once

#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Share of the points `seen` that lie on the points `map`, in [0, 1], as a mean likelihood; 0 if `map` or `seen` is
/// empty. All points are in one frame.
double shareOnWalls(const std::vector<Eigen::Vector2f>& map, const std::vector<Eigen::Vector2f>& seen);

/// Three numbers. The first is the distance driven where the robot had been before, at least `min_travel` [m] of travel
/// earlier. The second is how much of that distance is unconfirmed, because no closure of the plugin `section` ties it
/// to the earlier visit and the scans do not fit what was seen then. The third is the share of the travel that lies
/// between two visits of a place; errors in the rest of the travel would go unnoticed. `labels`: as for
/// throughWalls().
std::vector<mapper::Evidence> revisits(const mapper::State& state, const std::string& section,
                                       const std::vector<std::string>& labels, double min_travel);

}  // namespace omnimapper::plugins
