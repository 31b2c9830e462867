#pragma once

#include <omnimapper/query/MapToAsk.h>

#include <string>

namespace omnimapper::query {

/// Everything that queries know of a map, as one JSON document in ASCII, from which a page draws it (doc/page.md):
/// places with their extents, rooms with their outlines, doors, and the last pose. Frame of the map [m].
std::string mapDocument(const MapToAsk& map);

}  // namespace omnimapper::query
