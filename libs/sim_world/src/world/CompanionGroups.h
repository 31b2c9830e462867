#pragma once

#include <omnimapper/sim_world/WorldIni.h>

#include <cstdint>
#include <vector>

namespace omnimapper::sim {

/// The people of a group, called companion_1, companion_2, ... Their heights depend on the seed, and so does the side
/// on which guests walk.
std::vector<CompanionPlan> companionsOf(CompanionGroup group, std::uint64_t seed);

}  // namespace omnimapper::sim
