#pragma once

#include <SectionBytes.h>

#include <string>

namespace omnimapper::testing {

/// The uncompressed content of the section of key frames: their number, then the key frames. For tests that damage it,
/// which need the private headers of `map`.
inline std::string unpackedFrames(const map::MapSection& frames) {
  base::ByteReader in(frames.bytes, "the section of a test");
  std::string bytes(in.raw(4));
  while (!in.atEnd()) bytes += map::readCompressed(in);
  return bytes;
}

/// The section with this content, compressed.
inline map::MapSection packedFrames(std::uint32_t version, const std::string& bytes) {
  base::ByteWriter out;
  out.raw(bytes.substr(0, 4));
  if (bytes.size() > 4) out.raw(map::compressed(bytes.substr(4)));
  return {"frames", version, out.take()};
}

}  // namespace omnimapper::testing
