#pragma once

#include <string>
#include <vector>

namespace omnimapper::building {

struct RoomsRequest {
  std::string grid;     ///< YAML file of a grid
  std::string output;   ///< folder
  std::string earlier;  ///< rooms.json whose ids are continued; empty: none
};

struct RoomsResult {
  std::string text;  ///< a summary of at most one screen
  std::vector<std::string> warnings;
};

/// The work of omnimapper-rooms: finds the rooms of a grid and writes rooms.json, rooms.png and plan.svg. Throws
/// Error(unreadable_input), Error(unwritable_output) or Error(disk_full), Error(nothing_to_map) if the grid shows no
/// room, and Error(out_of_memory) for a grid of more than 100 million cells.
RoomsResult runRooms(const RoomsRequest& request);

}  // namespace omnimapper::building
