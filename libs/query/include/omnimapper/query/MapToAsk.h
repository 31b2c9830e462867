#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/map/ClosedLoops.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// The part of a map that is loaded to answer queries: only its places, its rooms, its loop closures, what people
/// corrected, and a list of its layers, however large the map is.
struct MapToAsk {
  std::string file;    ///< the map file
  std::string folder;  ///< the folder of the map file, which also has the occupancy grid
  map::Places places;
  std::vector<map::MapFile::Entry> layers;     ///< the layers that the file has
  std::optional<building::Storey> rooms = {};  ///< its layer of rooms; none if it has none that this program can read
  std::vector<map::ClosedLoop> loops = {};     ///< the loop closures that the map rests on
  map::Corrections corrections = {};           ///< what people corrected
  std::string id = {};                         ///< the same for maps with the same places and rooms
};

/// Opens a map; `path` is a map file or its folder. Throws Error(unreadable_input), naming the file and the remedy, if
/// it is missing, damaged, of a later version, or has no places because an earlier OmniMapper wrote it.
MapToAsk openMap(const std::string& path);

/// Whether that is the map file of a live run that goes on, or that crashed.
bool isCheckpoint(const std::string& file);

}  // namespace omnimapper::query
