#pragma once

#include <omnimapper/building/Storey.h>

#include <string>
#include <vector>

namespace omnimapper::building {

/// A sign on a wall, in the frame of the map.
struct DoorSign {
  std::string id;            ///< of the landmark: "0:111"
  std::string text;          ///< "213"
  Eigen::Vector2d position;  ///< [m]
  Eigen::Vector2d facing;    ///< unit, from the wall to those who read it
  bool is_repeated = false;  ///< other doors have signs with the same text, which is therefore no name of one room
};

/// Limits for a sign that belongs to a door. doc/results/rooms.md says on what they were chosen.
struct DoorSignOptions {
  double reach = 1.2;         ///< [m] along the wall, from the nearer end of the door
  double off_wall = 0.6;      ///< [m] between the sign and the line of the door
  double least_facing = 0.7;  ///< cosine of the angle between the sign and the door
  double behind = 0.6;        ///< [m] behind the wall, where the room of a sign without a door is looked for
};

/// Names rooms by the signs beside their doors: a sign names the room behind the nearest door in whose wall it hangs,
/// on the side from which it can be read. A sign that has no such door names a room that was not seen (Storey::unseen),
/// unless the place behind its wall is in a known room: then it names that room, with less confidence. Names, evidence
/// and unseen rooms that earlier signs gave are replaced; names of users stay. Signs of which a text is a command or
/// the way out ("Exit") name nothing.
void nameBySigns(Storey& storey, const std::vector<DoorSign>& signs, const DoorSignOptions& options = {});

}  // namespace omnimapper::building
