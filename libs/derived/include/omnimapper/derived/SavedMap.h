#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

namespace omnimapper::derived {

/// What a map file holds.
struct SavedMap {
  map::Map map;
  graph::Graph graph;
  /// Planar if the poses of the map lie in the plane, else spatial.
  mapper::Motion motion() const;
};

/// Reads a map file of this or any earlier version; `path` may be the folder that holds map.omnimap. The result has at
/// least one key frame, and its parts fit together. Throws Error(unreadable_input), naming the file, if it is missing
/// or damaged, has a later version, or needs plugins that are not loaded.
SavedMap readMap(const std::string& path, const mapper::Kinds& kinds);

/// The file of a map: the sections graph, frames, landmarks and sessions, then one for each layer but "places" and
/// "loops". If the file is written, read and written again, it has the same bytes.
map::MapFile mapFileOf(const map::Map& map, const graph::Graph& graph);

/// The same with the layer "places", which queries need, and "loops" if loops were closed. May be called in any thread
/// with a state of its own.
map::MapFile mapFileToAsk(const mapper::State& state);

}  // namespace omnimapper::derived
