#pragma once

#include <omnimapper/building/Storey.h>

#include <string>
#include <vector>

namespace omnimapper::building {

/// The JSON document rooms.json (doc/rooms.md describes it). `gone` are ids of rooms of an earlier map that are none
/// any more (continueRooms()).
std::string encodeRooms(const Building& building, const std::vector<int>& gone = {});

/// Reads a document of encodeRooms(). Throws Error(unreadable_input), naming file and reason, if it is missing, is
/// none, or was written by a later version.
Building readRooms(const std::string& file);

}  // namespace omnimapper::building
