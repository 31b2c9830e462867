#pragma once

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <system_error>

namespace omnimapper::exports {

/// Path of a file in the output folder. Throws Error(unwritable_output) in a run without one.
inline std::string outputPath(const mapper::PluginContext& context, const std::string& name) {
  if (context.output_folder.empty()) {
    throw base::Error(base::ExitCode::unwritable_output, "[" + context.section + "] writes " + name +
                                                             ", but the run has no output folder: give one with -o.");
  }
  return context.output_folder + "/" + name;
}

/// Writes bytes whole or not at all. Throws Error(disk_full).
inline void writeBytes(const std::string& path, const std::string& bytes) {
  base::writeFile(path,
                  [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

/// For what this run has nothing to put in: removes the file if an older run left one, which would pass for this run's.
/// Throws Error(unwritable_output) if that fails.
inline void removeFile(const std::string& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (!error) return;
  throw base::Error(base::ExitCode::unwritable_output, path +
                                                           ": this run has nothing to write there, and the file of " +
                                                           "an older run cannot be removed: " + error.message());
}

}  // namespace omnimapper::exports
