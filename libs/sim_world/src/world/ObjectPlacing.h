#pragma once

#include <omnimapper/sim_world/ObjectMaking.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

#include "StandingThings.h"

namespace omnimapper::sim {

/// Indices of the objects of a plan in an order in which each comes after those that carry it and that it touches;
/// otherwise they are in the order of the plan. Throws base::Error naming the section of an object that would carry
/// itself.
std::vector<std::size_t> orderOfPlacing(const WorldPlan& plan);

/// Makes the objects of a plan, each with its track, in the order of the plan. Throws base::Error naming the section of
/// an object that cannot be made or stands nowhere.
std::vector<MadeObject> placeObjects(const WorldPlan& plan, StandingSpace& floor);

}  // namespace omnimapper::sim
