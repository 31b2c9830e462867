#pragma once

#include <omnimapper/source/LogLook.h>

#include <string>
#include <vector>

namespace omnimapper::ros {

/// Whether this is a file of ROS, or a folder of ROS 2 with such files.
bool looksLikeRos(const source::LogLook& look);

/// The files of a log: the file itself, or the files of the folder of a split log, in the order of metadata.yaml. Files
/// that are listed there and missing are in `missing`. Throws Error(unreadable_input) if the folder has no such file.
struct LogFiles {
  explicit LogFiles(const std::string& path);
  std::vector<std::string> present, missing;
};

}  // namespace omnimapper::ros
