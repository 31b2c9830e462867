#pragma once

#include <omnimapper/map/Places.h>

#include <string>

namespace omnimapper::query {

/// What of a map is loaded to answer queries: its places alone, however large the map is.
struct MapToAsk {
  std::string file;    ///< the map file
  std::string folder;  ///< that it lies in: there is its occupancy grid, too
  map::Places places;
};

/// `path`: a map file or the folder of one. Throws Error(unreadable_input), naming the file and the remedy, if it is
/// missing, damaged, of a later version, or has no places because an earlier OmniMapper wrote it.
MapToAsk openMap(const std::string& path);

}  // namespace omnimapper::query
