#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/query/TextMatch.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// The rooms of a map. Throws Error(unreadable_input), naming the remedy, if it has none.
const building::Storey& roomsOf(const MapToAsk& map);

/// A room, or one that was not seen, whose name fits a text.
struct FoundRoom {
  const building::Room* room = nullptr;          ///< null for an unseen room
  const building::UnseenRoom* unseen = nullptr;  ///< null for a room
  TextMatch match;
};

/// The rooms called `text`, the best match first: by the name of a sign or user, by a sure kind ("kitchen"), or as
/// "room 3". As with landmarks, similar names count only if none fits. Empty if the map has no rooms. The result points
/// into `map`.
std::vector<FoundRoom> findRooms(const MapToAsk& map, const std::string& text);

/// The room that a landmark is in: the one on its free side if it hangs on a wall or is one. Null if it is in none.
const building::Room* roomOf(const building::Storey& storey, const map::Place& place);

}  // namespace omnimapper::query
