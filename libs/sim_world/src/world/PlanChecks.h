#pragma once

#include <omnimapper/sim_world/WorldPlan.h>

#include <cstdint>
#include <string>

namespace omnimapper::sim {

void refuseUnknownMaterial(const WorldPlan& plan, const std::string& section, const std::string& key,
                           const std::string& name);

/// Throws base::Error(out_of_range) if two sections of a plan have the same name.
void refuseTwins(const WorldPlan& plan);
/// Throws base::Error(out_of_range) if the place is so large that a grid of its floor might not fit into memory.
void refuseHugePlaces(const WorldPlan& plan);

/// The seed of the object of this number in a plan.
std::uint64_t seedOfObject(std::uint64_t world_seed, std::size_t number);
/// Extents along x and y of the smallest box about the body's z axis that holds it, and its height [m].
Eigen::Vector3d reachOf(const Body& body);

}  // namespace omnimapper::sim
