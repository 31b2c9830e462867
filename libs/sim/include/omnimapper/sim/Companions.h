#pragma once

#include <omnimapper/sim_world/World.h>
#include <omnimapper/sim_world/WorldPlan.h>

namespace omnimapper::sim {

/// Adds the people who accompany the robot to a world that was made from the plan. The drive must have been planned
/// without them, so that they do not change it. Each walks as near to its wished place as walls, furniture, the robot
/// and the people before it allow; the middle of its body stays 0.45 m or more away from the base's origin, and nobody
/// walks faster than 2 m/s. Throws base::Error(out_of_range), which names file, section and key, if there is no room
/// beside the robot, or if the drive takes more than 7200 s.
void addCompanions(World& world, const WorldPlan& plan, const Track& map_from_base, double robot_radius);

}  // namespace omnimapper::sim
