#pragma once

#include <omnimapper/source/LogLook.h>

#include <string>

namespace omnimapper::source {

/// What the file or folder at `path` seems to be, by its names and first bytes, and what to do with it, as the end of a
/// sentence: "is a CARMEN log, which -r reads ...". Throws Error(unreadable_input) for a file
/// that cannot be opened.
std::string describeInput(const std::string& path);

/// Whether this is the folder of a map or of a localization, which is no log, whatever pictures are in it.
bool isFolderOfRun(const LogLook& look);

}  // namespace omnimapper::source
