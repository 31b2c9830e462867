#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/Motion.h>

#include <cstddef>
#include <vector>

namespace omnimapper::mapper {

/// Localisation in a map that stands: everything of earlier sessions is held, and of the running one only the newest
/// key frames are free. One that leaves the window is retired: held where it is, its observations let go, and what its
/// factors told is left as a prior of the next key frame (its marginal). So neither the time nor, but for the
/// trajectory itself, the memory that a key frame takes grows with the length of the log.
class SlidingWindow {
 public:
  /// `key_frames` stay free at least. `map` and `graph` stay the caller's.
  SlidingWindow(Motion motion, std::size_t key_frames, map::Map& map, graph::Graph& graph)
      : motion_(motion), size_(key_frames), map_(map), graph_(graph) {}

  /// Before the first key frame of the running session: holds every variable at its value and lets go of all factors,
  /// which have nothing left to say.
  void holdMap();
  /// Retires what has left the window, as far as it is older than `stamp`, oldest first, once the session is joined:
  /// before that nobody knows where to hold it. The ids of what it retired.
  std::vector<base::KeyFrameId> retire(base::Stamp stamp);
  /// So many key frames are held; they come first in the map's order.
  std::size_t held() const { return held_; }

 private:
  void retire(base::VariableId gone, base::VariableId heir);

  Motion motion_;
  std::size_t size_;
  map::Map& map_;
  graph::Graph& graph_;
  std::size_t held_ = 0;
};

}  // namespace omnimapper::mapper
