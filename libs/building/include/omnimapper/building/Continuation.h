#pragma once

#include <omnimapper/building/Segmentation.h>

#include <vector>

namespace omnimapper::building {

/// The rooms of a map that was continued or made anew, with the ids that they had before.
struct Continuation {
  Segmentation now;
  /// Ids of earlier rooms that are no rooms of their own any more: their space is a part of other rooms now, or was
  /// not seen.
  std::vector<int> gone;
};

/// Gives the rooms and doors of `now`, a segmentation of `grid`, the ids of those of `earlier` at the same places, in
/// the same frame. A room keeps its id if it is the largest part of what the earlier room covered, and the earlier room
/// the largest part of it that has an id. All others get ids that no room has had; Room::split_from is the earlier room
/// that covered most of them, if it covered half of them. Doors that join the same rooms keep their ids if their
/// middles have moved by less than 0.5 m. A room that keeps its id keeps name, kind and their evidence, unless a user
/// has named the room of `now`.
Continuation continueRooms(const Storey& earlier, const grid::GridMap& grid, Segmentation now);

}  // namespace omnimapper::building
