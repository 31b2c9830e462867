#pragma once

#include <omnimapper/source/LogLook.h>

#include <string>
#include <string_view>

namespace omnimapper::source {

/// What the file or folder at `path` seems to be, by its names and first bytes, and what to do with it, as the end of a
/// sentence: "is a CARMEN log, which -r reads ...". Throws Error(unreadable_input) for a file
/// that cannot be opened.
std::string describeInput(const std::string& path);

/// If the file at `path` begins with `head` as compressed files do (gzip, bzip2, xz, Zstandard): that it is compressed
/// and how it is unpacked, as the end of a sentence. Empty if it does not.
std::string describePacking(const std::string& path, std::string_view head);

/// Whether this is the folder of a map or of a localization, which is no log, whatever pictures are in it.
bool isFolderOfRun(const LogLook& look);

}  // namespace omnimapper::source
