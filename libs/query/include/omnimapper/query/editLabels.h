#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/LabelEdits.h>

#include <string>
#include <vector>

namespace omnimapper::query {

/// A change of what people named.
struct LabelEdit {
  /// One of: name ID TEXT, the landmark or thing with that id; name X Y TEXT, a point of the floor [m]; rename OLD NEW;
  /// delete TEXT; undo.
  std::vector<std::string> words;
  std::string who;   ///< who asks; may be empty
  base::Stamp when;  ///< when it was asked
};

/// Changes the labels of a saved map in `path`, its file or its folder, and its places, which queries read. The file is
/// replaced as a whole and is on the disk when this returns. `history` is that of earlier calls, for undo; if somebody
/// else has changed the labels since, it is forgotten. It waits up to 5 s for another program that changes the map, and
/// throws Error(unwritable_output) if that takes longer. Returns what was done, a few words. Throws Error(command_line)
/// if the edit is none, or changes nothing; Error(unreadable_input) if the map cannot be read, or is that of a live run
/// which has not ended; Error(unwritable_output) or Error(disk_full). The map and `history` are then as before.
std::string editLabels(const std::string& path, const LabelEdit& edit, map::LabelEdits& history);

}  // namespace omnimapper::query
