#pragma once

#include <fstream>
#include <string>

namespace omnimapper::base {

/// Opens a file for reading. Throws Error(unreadable_input), naming the path, the expected kind of file and the reason,
/// if the file cannot be opened or is not a regular file. (Opening a pipe without a writer would block forever, and a
/// device may have no end.) If a run was killed while it replaced its outputs, the new file is opened (see
/// committedPath()).
std::ifstream openInput(const std::string& path, const std::string& kind = "file");

/// Reads a whole file. Throws as openInput() does, and Error(damaged_input) if the disk fails before the end of the
/// file.
std::string readInput(const std::string& path, const std::string& kind = "file");

}  // namespace omnimapper::base
