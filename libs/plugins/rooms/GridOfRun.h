#pragma once

#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/grid/GridMap.h>

namespace omnimapper::plugins {

/// The same grid as a grid in the frame of the map.
grid::GridMap gridMapOf(const derived::ScanGrid& grid);

/// The grid with the way of the base over it free (building::freeDrivenWay()). `radius` [m] is that of the robot.
grid::GridMap withDrivenWay(grid::GridMap grid, const map::Map& map, double radius);

}  // namespace omnimapper::plugins
