#pragma once

#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// The results of SlipSearch: the slips that were corrected, and whether closures that agree with one another still
/// contradict the map, because no accepted closure resolves the contradiction. `decisions`: those of this run.
std::vector<mapper::Evidence> slips(const mapper::State& state, const std::string& section,
                                    const mapper::DecisionLog& decisions);

}  // namespace omnimapper::plugins
