#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/grid/GridMap.h>

#include <cstdint>
#include <vector>

namespace omnimapper::building {

/// The id of the room at each cell of a grid, by the outlines of the rooms; 0 for none. In the order of the cells.
std::vector<std::int32_t> roomsOfCells(const Storey& storey, const grid::GridMap& grid);

}  // namespace omnimapper::building
