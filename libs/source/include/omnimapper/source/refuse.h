#pragma once

#include <omnimapper/base/Error.h>

#include <string>

namespace omnimapper::source {

/// Throws Error(unreadable_input) that names `path` and why it cannot be read.
[[noreturn]] inline void refuse(const std::string& path, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": " + reason);
}

}  // namespace omnimapper::source
