#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Motion.h>

#include <cstddef>
#include <vector>

namespace omnimapper::mapper {

/// Localisation in a map that stands: everything of earlier sessions is held, and of the running one only the newest
/// key frames are free. One that leaves the window is retired: held where it is, its observations let go, and what its
/// factors told of the next key frame is left as a prior of that (its marginal); factors that bind a third free
/// variable are let go. So what a key frame costs hardly grows with the length of the log: there is the trajectory, and
/// passes over the ids of all that is held.
class SlidingWindow {
 public:
  /// `key_frames` stay free at least. `map` and `graph` stay the caller's.
  SlidingWindow(Motion motion, std::size_t key_frames, map::Map& map, graph::Graph& graph)
      : motion_(motion), size_(key_frames), map_(map), graph_(graph) {}

  /// Before the first key frame of the running session: holds every variable at its value and lets go of all factors,
  /// which have nothing left to say.
  void holdMap();
  /// Retires what has left the window, as far as it is older than `stamp`, oldest first, once the session is joined and
  /// that has stood for some key frames: before that nobody knows where to hold it. The ids of what it retired.
  std::vector<base::KeyFrameId> retire(base::Stamp stamp);
  /// From then on nothing can take back that the session is joined.
  bool hasRetired() const { return held_ > of_map_; }
  /// So many key frames are held; they come first in the map's order.
  std::size_t held() const { return held_; }

 private:
  bool mayRetire() const;
  void retireAnchor();
  void retire(base::VariableId gone, base::VariableId heir);

  Motion motion_;
  std::size_t size_;
  map::Map& map_;
  graph::Graph& graph_;
  std::size_t held_ = 0, of_map_ = 0;
};

}  // namespace omnimapper::mapper
