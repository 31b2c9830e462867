#pragma once

#include <omnimapper/grid/GridMap.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::building {

/// Frees the cells of a grid that a robot has driven over: within `radius` [m] of the straight lines between
/// consecutive points of its way [m, frame of the map] that are at most `longest_step` [m] apart, and of each point.
/// What was driven through is no wall: people who stood there, and doors that were open for a part of the time, are in
/// a grid as obstacles.
void freeDrivenWay(grid::GridMap& grid, const std::vector<Eigen::Vector2d>& way, double radius,
                   double longest_step = 2);

}  // namespace omnimapper::building
