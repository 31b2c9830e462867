#pragma once

#include <string>

namespace mesh_output {

/// What is written of a text, and the ending that its file's name gets.
struct Compressed {
  std::string bytes, ending;
};

/// The text in the format of gzip with the ending ".gz", or unchanged with no ending if zlib was missing when this
/// library was built.
Compressed compressed(const std::string& text);

}  // namespace mesh_output
