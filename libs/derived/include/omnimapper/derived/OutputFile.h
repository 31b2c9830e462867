#pragma once

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <ostream>
#include <string>

namespace omnimapper::derived {

/// Path of a file in the output folder. Throws Error(unwritable_output) if the run has no output folder.
inline std::string outputPath(const mapper::PluginContext& context, const std::string& name) {
  if (context.output_folder.empty()) {
    throw base::Error(base::ExitCode::unwritable_output, "[" + context.section + "] writes " + name +
                                                             ", but the run has no output folder: give one with -o.");
  }
  return context.output_folder + "/" + name;
}

/// Writes the whole file or none of it. Throws Error(disk_full).
inline void writeBytes(const std::string& path, const std::string& bytes) {
  base::writeFile(path,
                  [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

}  // namespace omnimapper::derived
