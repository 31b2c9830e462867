#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/WorldPlan.h>

namespace omnimapper::sim {

/// Draws new places for the openings of a plan whose rooms are rectangles along the axes. Each stays in the wall
/// nearest to its place, and keeps its order among the openings of that wall, so that no two overlap. Open leaves of
/// doors keep clear of other doorways. Windows are 80 to 130 % as wide as before, where the wall is long enough.
/// Passages over a whole border (width 0) stay. Windows and doors to the outside that now face a room, or find no space
/// in their wall, are removed.
void redrawOpeningPlaces(WorldPlan& plan, Random& random);

}  // namespace omnimapper::sim
