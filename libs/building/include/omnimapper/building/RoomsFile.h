#pragma once

#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/building/Storey.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::building {

/// The layer of a map that holds its rooms: the document of encodeRooms().
inline constexpr char kRoomsLayer[] = "rooms";
inline constexpr std::uint32_t kRoomsLayerVersion = 1;

/// The JSON document rooms.json (doc/rooms.md describes it). `gone` are ids of rooms of an earlier map that are none
/// any more (continueRooms()).
std::string encodeRooms(const Building& building, const std::vector<int>& gone = {});

/// Reads a document of encodeRooms(). Throws Error(unreadable_input), naming file and reason, if it is missing, is
/// none, or was written by a later version.
Building readRooms(const std::string& file);

/// What a document of encodeRooms() holds.
struct RoomsDocument {
  Building building;      ///< with at least one storey
  std::vector<int> gone;  ///< ids
  RoomEdits edits;        ///< that were applied to the rooms
};
std::string encodeRooms(const RoomsDocument& document);
/// Reads such a document. Throws Error(unreadable_input), naming `what` and the reason, if it is none, is damaged, or
/// was written by a later version.
RoomsDocument decodeRooms(const std::string& text, const std::string& what);

}  // namespace omnimapper::building
