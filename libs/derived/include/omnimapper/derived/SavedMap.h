#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <string>
#include <vector>

namespace omnimapper::derived {

/// What a map file holds.
struct SavedMap {
  map::Map map;
  graph::Graph graph;
  /// All other sections in their order: those of plugins and unknown ones. The section "places" is left out, because it
  /// is computed from the other data.
  std::vector<map::MapSection> sections;

  /// Planar if the poses of the map lie in the plane, else spatial.
  Motion motion() const;
};

/// Reads a map file of this or any earlier version; `path` may be the folder that holds map.omnimap. The result has at
/// least one key frame, and its parts fit together. Throws Error(unreadable_input), naming the file, if it is missing
/// or damaged, has a later version, or needs plugins that are not loaded.
SavedMap readMap(const std::string& path, const Kinds& kinds);

/// The file of a map: the sections for graph, frames, landmarks and sessions, then `sections` unchanged. If the file is
/// written, read and written again, it has the same bytes.
map::MapFile mapFileOf(const map::Map& map, const graph::Graph& graph, const std::vector<map::MapSection>& sections);

}  // namespace omnimapper::derived
