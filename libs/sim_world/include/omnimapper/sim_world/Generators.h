#pragma once

#include <omnimapper/sim_world/WorldIni.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Names of the generators of places, "home", "office", ...
const std::vector<std::string>& generatorNames();

/// The plan of the place that options.generator makes with options.seed and plan_seed; an empty plan for "none". Throws
/// base::Error(out_of_range) for an unknown generator, with the nearest name, and for a plan_seed above 0 if the
/// generator has one plan only.
WorldPlan generate(const WorldOptions& options, const std::string& file_for_messages);

}  // namespace omnimapper::sim
