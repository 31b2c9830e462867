#pragma once

#include <string>

namespace omnimapper::source {

/// What the file or folder at `path` seems to be, by its names and first bytes, and what to do with it, as the end of a
/// sentence: "is a CARMEN log; make it a rawlog with: omnimapper-import ...". Throws Error(unreadable_input) for a file
/// that cannot be opened.
std::string describeInput(const std::string& path);

}  // namespace omnimapper::source
