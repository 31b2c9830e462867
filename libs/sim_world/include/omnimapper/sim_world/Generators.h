#pragma once

#include <omnimapper/sim_world/WorldIni.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Names of the generators of places, "home", "office", ...
const std::vector<std::string>& generatorNames();

/// The place that options.generator makes, with options.seed, as plain descriptions; of "none" an empty one.
/// Throws base::Error(out_of_range) for an unknown generator, with the nearest name.
WorldPlan generate(const WorldOptions& options, const std::string& file_for_messages);

}  // namespace omnimapper::sim
