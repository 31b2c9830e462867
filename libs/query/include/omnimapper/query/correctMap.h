#pragma once

#include <omnimapper/base/Stamp.h>

#include <string>
#include <vector>

namespace omnimapper::query {

/// A correction of what a map says.
struct Correction {
  /// One of: delete ID, the landmark with that id is nothing; restore ID, it is something after all; forbid FROM TO,
  /// the loop closure between these key frames is wrong; allow FROM TO, it is right after all. Ids as in "0:12".
  std::vector<std::string> words;
  std::string who;   ///< who corrects; may be empty
  base::Stamp when;  ///< when
};

/// Corrects a saved map in `path`, its file or its folder: the layer map::Corrections, to which later sessions keep,
/// and the places, which queries read. The file is replaced as a whole and is on the disk when this returns. It waits
/// for other programs as editLabels() does. Returns what was done, a few words. Throws Error(command_line) if the
/// correction is none, or changes nothing; Error(unreadable_input) if the map cannot be read, or is that of a live run
/// which has not ended; Error(unwritable_output) or Error(disk_full). The map is then as before.
std::string correctMap(const std::string& path, const Correction& correction);

}  // namespace omnimapper::query
