#pragma once

#include <omnimapper/query/Goal.h>
#include <omnimapper/query/RoomsAsked.h>
#include <omnimapper/query/Verbs.h>

#include <optional>

#include "PlaceJson.h"

namespace omnimapper::query {

/// The room that `goal` means by a text: its best match if that is a room that was seen, and no landmark has a better
/// name. None else, nor if the room was seen in part and a landmark has the name.
std::optional<FoundRoom> goalRoom(const MapToAsk& map, const std::string& text);

/// The answer of `goal` for a room: its centre, moved to where the robot fits (thesis 6.2.6). The yaw is the direction
/// in which it arrives. None if the robot fits nowhere in the room. `document` is the answer as begun.
std::optional<Answer> answerGoalOfRoom(const building::Room& target, const RoomToMove& room, const GridMap& grid,
                                       const building::Storey& storey, double radius, Json document);

}  // namespace omnimapper::query
