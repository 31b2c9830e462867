#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plugin/View.h>

#include <iosfwd>
#include <string>

// Reading and writing the id of a variable in a plugin's section of a map file.
namespace omnimapper::mapper {

inline void writeVariableId(std::ostream& out, base::VariableId id) {
  graph::writeId(out, id);
}

/// Throws Error(unreadable_input) if the graph has no such variable.
inline base::VariableId readVariableId(std::istream& in, const View& view, const std::string& section) {
  const auto id = graph::readId<base::VariableId>(in);
  if (!view.graph.contains(id)) {
    throw base::Error(base::ExitCode::unreadable_input, "map file, section \"" + section + "\": variable " +
                                                            toString(id) + " is not in the graph: the file is damaged");
  }
  return id;
}

/// Throws Error(unreadable_input) if the version is later than `newest`.
inline void expectVersion(const map::MapSection& saved, std::uint32_t newest) {
  if (saved.version <= newest) return;
  throw base::Error(base::ExitCode::unreadable_input,
                    "map file, section \"" + saved.name + "\" is of version " + std::to_string(saved.version) +
                        ", and this program reads versions up to " + std::to_string(newest) +
                        ". Use the OmniMapper that wrote it, or a later one.");
}

}  // namespace omnimapper::mapper
