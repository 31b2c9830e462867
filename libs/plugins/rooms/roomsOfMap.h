#pragma once

#include <omnimapper/grid/GridMap.h>
#include <omnimapper/plugin/State.h>

#include <string>
#include <utility>
#include <vector>

#include "RoomsLayer.h"

namespace omnimapper::plugins {

/// The rooms of a map, and what became of the edits of users.
struct EditedRooms {
  RoomsLayer layer;
  /// An edit, or all of them, and why it could not be applied and whether it is kept; empty for one that was.
  std::vector<std::pair<std::string, std::string>> edits;
};

/// The rooms of a map, found in `grid`, named by the map's door signs and by what is in them, and edited as users did.
/// Rooms of the map's layer of rooms keep their ids and names, and its edits come before the given ones. The layer
/// keeps its edits also if they cannot be applied now; given ones that it has already are not applied again.
EditedRooms roomsOfMap(const mapper::State& state, const grid::GridMap& grid, const building::RoomEdits& edits);

}  // namespace omnimapper::plugins
