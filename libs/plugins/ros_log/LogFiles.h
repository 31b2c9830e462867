#pragma once

#include <omnimapper/source/LogLook.h>

#include <string>
#include <vector>

namespace omnimapper::ros {

/// Whether this is a file of ROS, or a folder of ROS 2 with such files.
bool looksLikeRos(const source::LogLook& look);

/// The files of a log: the file itself, or the files of the folder of a split log, in the order of metadata.yaml. Files
/// that are listed there and missing are in `missing`, logs that are there and not listed in `left_out`. Without
/// metadata.yaml, files called NAME_0.db3, NAME_1.db3 and so on are one log. Throws Error(unreadable_input) if the
/// folder has no such file, or several logs, which it then lists.
struct LogFiles {
  explicit LogFiles(const std::string& path);
  std::vector<std::string> present, missing, left_out;
};

}  // namespace omnimapper::ros
