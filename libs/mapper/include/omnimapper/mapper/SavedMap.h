#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What a map file holds.
struct SavedMap {
  map::Map map;
  graph::Graph graph;
  /// All others in their order: of plugins, and those that nobody here knows. Not "places", which follows from the
  /// rest.
  std::vector<map::MapSection> sections;

  /// Whether its poses lie in the plane.
  Motion motion() const;
};

/// Reads a map file of this or any earlier version; `path` may be the folder that holds map.omnimap. What it gives has
/// at least one key frame, and its parts fit each other. Throws Error(unreadable_input) naming the file if that cannot
/// be had: missing, damaged, of a later version, of plugins that are not loaded.
SavedMap readMap(const std::string& path, const Kinds& kinds);

/// The file of a map: graph, frames, landmarks and sessions, then the others as they stand. Written, read and written
/// again it has the same bytes.
map::MapFile mapFileOf(const map::Map& map, const graph::Graph& graph, const std::vector<map::MapSection>& sections);

}  // namespace omnimapper::mapper
