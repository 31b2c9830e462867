#pragma once

#include <string>
#include <vector>

namespace omnimapper::building {

struct RoomsEditRequest {
  std::string folder;              ///< with rooms.json and grid.yaml, or the YAML file of the grid beside rooms.json
  std::vector<std::string> words;  ///< the edit: rename ROOM NAME, merge ROOM ROOM, split X Y X Y, delete ROOM, or
                                   ///< move-door DOOR X Y X Y; a room is its number or name
};

/// The folder of the files that an edit changes.
std::string editedFolder(const RoomsEditRequest& request);

struct RoomsEditResult {
  std::string text;   ///< what was done, one line
  std::string rooms;  ///< the new rooms.json, which is also the layer of a map
};

/// The work of omnimapper-rooms MAP edit: changes rooms.json, rooms.png and plan.svg of a folder, and adds the edit to
/// edits.json; none of them if the edit fails. Throws Error(command_line) for an edit that is none or cannot be
/// applied, Error(unreadable_input), Error(unwritable_output) or Error(disk_full).
RoomsEditResult runRoomsEdit(const RoomsEditRequest& request);

}  // namespace omnimapper::building
