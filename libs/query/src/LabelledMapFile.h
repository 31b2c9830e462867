#pragma once

#include <omnimapper/map/Labels.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::query {

/// A map file whose places or labels change.
struct LabelledMapFile {
  map::MapFile file;
  map::Places places;
  map::Labels labels;
  std::vector<map::FramePose> frames;
  std::map<base::LandmarkId, base::LandmarkId> current;  ///< into which landmarks were merged

  /// Throws Error(unreadable_input) if the map cannot be read, or lacks what labels need.
  static LabelledMapFile read(const std::string& path);
  /// Gives the places their names anew, and replaces the file as a whole. Throws as map::MapFile::write().
  void write(const std::string& path);
};

}  // namespace omnimapper::query
