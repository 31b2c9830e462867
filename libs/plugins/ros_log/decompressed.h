#pragma once

#include <string>
#include <string_view>

namespace omnimapper::ros {

/// What came out of compressed bytes.
struct Decompressed {
  std::string bytes;    ///< all, or what is before the problem
  std::string problem;  ///< a clause whose subject is the compressed data; empty if all is well
};

/// Whether the name is that of a compression that decompressed() knows: none (also as an empty name), bz2, lz4, zstd.
bool isKnownCompression(std::string_view name);

/// Decompresses into at most `most` bytes: more is a problem. Memory grows with what comes out, not with `most`.
Decompressed decompressed(std::string_view compression, std::string_view bytes, std::size_t most);

/// Whether the bytes begin as a frame of Zstandard does.
bool isZstd(std::string_view bytes);

}  // namespace omnimapper::ros
