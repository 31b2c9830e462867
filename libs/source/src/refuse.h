#pragma once

#include <omnimapper/base/Error.h>

#include <string>

namespace omnimapper::source {

/// Throws base::Error: the file or folder at `path` cannot be read, and why.
[[noreturn]] inline void refuse(const std::string& path, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": " + reason);
}

}  // namespace omnimapper::source
