#pragma once

#include <string>
#include <vector>

namespace omnimapper::query {

/// Changes the rooms of a map: the files that building::runRoomsEdit() changes, and the layer of the map in `path`, its
/// folder or the YAML file of its grid, which queries read. `words` are those of RoomsEditRequest. Returns what was
/// done, one line. It waits for other programs as editLabels() does. Throws as runRoomsEdit() does, and
/// Error(unreadable_input) if the map cannot be read, before any file is changed.
std::string editRooms(const std::string& path, const std::vector<std::string>& words);

}  // namespace omnimapper::query
