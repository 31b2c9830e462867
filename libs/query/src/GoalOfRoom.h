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

/// The free space in which a goal is sought.
struct GoalSpace {
  const RoomToMove& room;
  const GridMap& grid;
  double radius;  ///< [m] of the robot
};

/// The answer of `goal` for a room: its centre, moved to where the robot fits (thesis 6.2.6). The yaw is the direction
/// in which it arrives. None if the robot fits nowhere in the room. `document` is the answer as begun.
std::optional<Answer> answerGoalOfRoom(const building::Room& target, const GoalSpace& space,
                                       const building::Storey& storey, Json document);

/// The same for a region of several landmarks that people gave one name: the middle of its hull, moved to where the
/// robot fits in the hull. None if the place is no region, or if the robot fits nowhere in it.
std::optional<Answer> answerGoalOfRegion(const map::Place& target, const GoalSpace& space, Json document);

/// A region as a room with outline and centre: the middle of its area. None if the place is no region or has no area.
std::optional<building::Room> roomOfRegion(const map::Place& place);

}  // namespace omnimapper::query
