#pragma once

#include <omnimapper/sim_world/WorldPlan.h>

#include <vector>

#include "StandingThings.h"

namespace omnimapper::sim {

/// The plan with two moves of its object for each carrying: the object is away from the begin on and at its new place
/// from the end on. Throws base::Error naming the person's section if it carries an object that is not there, has moves
/// of its own, or is in another hand at that time.
WorldPlan withMovesByHand(WorldPlan plan);

/// What a person carries, with the poses of the objects before and after it. `world` has the objects, each with the
/// track that its moves give. Throws base::Error naming the person's section if an object is away when it should be
/// taken.
std::vector<PersonSpec::Carrying> carryingsOf(const WorldPlan& plan, const std::string& person, const World& world);

/// Gives carried objects, and what stands on them, tracks that go with the hands; until then they are away meanwhile.
/// Throws base::Error naming the section of an object that stands on a carried one and has moves of its own.
void moveByHand(const WorldPlan& plan, const StandingSpace& floor, std::vector<MadePerson::Carried> carried,
                World& world);

}  // namespace omnimapper::sim
