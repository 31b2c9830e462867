#pragma once

#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/MapSection.h>

#include <string>

// Functions that the sections of a map file share.
namespace omnimapper::map {

using base::ByteReader;
using base::ByteWriter;

template <class Tag>
void writeId(ByteWriter& out, base::Id<Tag> id) {
  out.uint(id.session, 2);
  out.uint(id.index, 4);
}

template <class Tag>
base::Id<Tag> readId(ByteReader& in) {
  base::Id<Tag> id;
  id.session = static_cast<std::uint16_t>(in.uint(2));
  id.index = static_cast<std::uint32_t>(in.uint(4));
  return id;
}

inline void writeStamp(ByteWriter& out, base::Stamp stamp) {
  out.uint(static_cast<std::uint64_t>(stamp.time_since_epoch().count()), 8);
}

inline base::Stamp readStamp(ByteReader& in) {
  return base::Stamp(base::Duration(static_cast<std::int64_t>(in.uint(8))));
}

/// A compressed byte holds at most this many bytes; a block that states more is damaged.
inline constexpr std::uint64_t kMostPerByte = 1032;

/// `bytes` as readCompressed() takes them: their length in 8 bytes, then a block of them compressed. Thread-safe.
std::string compressed(const std::string& bytes);
/// Reads a block that compressed() returned. Throws Error(unreadable_input) if it is damaged.
std::string readCompressed(ByteReader& in);

inline std::string placeOf(const std::string& section) {
  return "map file, section \"" + section + "\"";
}

[[noreturn]] inline void refuse(const std::string& section, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, placeOf(section) + ": " + reason);
}

/// Throws Error(unreadable_input) if it is another section, or of a version this program does not know.
inline void expectSection(const MapSection& section, const std::string& name, std::uint32_t newest) {
  if (section.name != name) refuse(name, "is expected, but the section is \"" + section.name + "\"");
  if (section.version >= 1 && section.version <= newest) return;
  refuse(name, "is of version " + std::to_string(section.version) + ", and this program reads versions up to " +
                   std::to_string(newest) + ". Use the OmniMapper that wrote it, or a later one.");
}

inline void expectEnd(const ByteReader& in, const std::string& name) {
  if (!in.atEnd()) refuse(name, "goes on after its last entry: the file is damaged");
}

}  // namespace omnimapper::map
