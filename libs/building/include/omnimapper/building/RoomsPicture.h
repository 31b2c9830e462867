#pragma once

#include <omnimapper/building/Segmentation.h>
#include <omnimapper/draw/Image.h>

namespace omnimapper::building {

/// A picture of the part of a grid that has been seen, y upwards: each room in a colour, which depends on its id alone,
/// with its id and area, paler where the room is open; doors red; obstacles black. Small grids are enlarged.
draw::Image drawRooms(const grid::GridMap& grid, const Segmentation& rooms);

}  // namespace omnimapper::building
