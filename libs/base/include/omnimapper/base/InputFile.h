#pragma once

#include <fstream>
#include <string>

namespace omnimapper::base {

/// Opens a file for reading from its first byte. Throws Error(unreadable_input), which names the path, the kind of file
/// that was expected and the reason, for one that cannot be opened and for what is no file: whoever opens a pipe that
/// nobody writes to waits for ever, and a device may have no end. A file of a run that was killed while it replaced
/// another's is the new one (see committedPath()).
std::ifstream openInput(const std::string& path, const std::string& kind = "file");

/// All its bytes. Throws as openInput() does, and Error(damaged_input) if the disk fails before the end.
std::string readInput(const std::string& path, const std::string& kind = "file");

}  // namespace omnimapper::base
