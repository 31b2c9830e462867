#pragma once

#include <omnimapper/sim_world/WorldPlan.h>

#include <vector>

#include "../robot/RobotSpace.h"
#include "RobotPath.h"

namespace omnimapper::sim {

/// Time between two places of a companion's path [s]; postures of people are computed at a multiple of its rate.
constexpr double kCompanionStep = 0.2;

/// Where a companion would like to be at 0, kCompanionStep, 2 kCompanionStep ... [m], `count` places. The places may
/// lie in walls, in furniture or in the robot. `space` is that of a person. `doors` are the middles of openings that
/// people walk through. Random numbers depend only on the companion's seed.
Polyline wishedPlaces(const CompanionPlan& plan, const RobotPath& robot, const RobotSpace& space,
                      const std::vector<Eigen::Vector2d>& doors, std::size_t count);

}  // namespace omnimapper::sim
