#pragma once

#include <omnimapper/grid/GridMap.h>

#include <string>

namespace omnimapper::query {

using grid::GridCell;
using grid::GridMap;

/// Reads grid.yaml and its image from a map's folder. Throws Error(unreadable_input), naming file, place and remedy, if
/// there is none, it cannot be read (grid::readGridMap()), or the grid is rotated.
GridMap readGrid(const std::string& folder);

}  // namespace omnimapper::query
