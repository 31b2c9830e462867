#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plugin/View.h>

#include <iosfwd>
#include <string>

// A variable that a plugin's section of a map file names.
namespace omnimapper::mapper {

inline void writeVariableId(std::ostream& out, base::VariableId id) {
  graph::writeUint(out, id.session, 2);
  graph::writeUint(out, id.index, 4);
}

/// Throws Error(unreadable_input) if the graph has no such variable.
inline base::VariableId readVariableId(std::istream& in, const View& view, const std::string& section) {
  base::VariableId id;
  id.session = static_cast<std::uint16_t>(graph::readUint(in, 2));
  id.index = static_cast<std::uint32_t>(graph::readUint(in, 4));
  if (!view.graph.contains(id)) {
    throw base::Error(base::ExitCode::unreadable_input, "map file, section \"" + section + "\": variable " +
                                                            toString(id) + " is not in the graph: the file is damaged");
  }
  return id;
}

/// Throws Error(unreadable_input) on a version of the future.
inline void expectVersion(const map::MapSection& saved, std::uint32_t newest) {
  if (saved.version <= newest) return;
  throw base::Error(base::ExitCode::unreadable_input,
                    "map file, section \"" + saved.name + "\" is of version " + std::to_string(saved.version) +
                        ", and this program reads versions up to " + std::to_string(newest) +
                        ". Use the OmniMapper that wrote it, or a later one.");
}

}  // namespace omnimapper::mapper
