#pragma once

#include <omnimapper/building/SegmentationOptions.h>
#include <omnimapper/building/Storey.h>
#include <omnimapper/grid/GridMap.h>

#include <cstdint>
#include <vector>

namespace omnimapper::building {

/// The rooms of a grid.
struct Segmentation {
  Storey storey;
  std::vector<std::int32_t> room_of_cell;  ///< id of the room, 0 for none; as many as the grid has cells, in its order
};

/// Cuts the free space of a grid into rooms, at doorways. Free-standing things of at most SegmentationOptions::clutter
/// count as free space of their room. Rooms have the ids 1, 2, ... in the order of their centres, from the top left;
/// doors likewise. The rooms are the same, up to the size of a cell, for all resolutions that show doors and walls.
/// Sources: extension of walls as in Luperto et al., Robust Structure Identification and Room Segmentation of Cluttered
/// Indoor Environments from Occupancy Grid Maps, 2022; narrow places of the distance transform as in Bormann et al.,
/// Room Segmentation: Survey, Implementation, and Analysis, 2016.
Segmentation segmentRooms(const grid::GridMap& grid, const SegmentationOptions& options = {});

}  // namespace omnimapper::building
