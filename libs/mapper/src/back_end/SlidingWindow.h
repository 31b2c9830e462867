#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Motion.h>

#include <cstddef>
#include <vector>

namespace omnimapper::mapper {

/// Localization in a fixed map: all variables of earlier sessions are held, and of the current session only the newest
/// key frames are free. A key frame that leaves the window is retired: its pose is held, its observations are dropped,
/// and its factors are replaced by a prior on the next key frame (their marginal); factors that bind a third free
/// variable are removed. The cost per key frame therefore hardly grows with the length of the log: only the trajectory
/// and passes over all held ids do.
class SlidingWindow {
 public:
  /// At least `key_frames` stay free. The caller owns `map` and `graph`.
  SlidingWindow(Motion motion, std::size_t key_frames, map::Map& map, graph::Graph& graph)
      : motion_(motion), size_(key_frames), map_(map), graph_(graph) {}

  /// Must be called before the first key frame of the session: holds every variable at its value and removes all
  /// factors, which then have no effect any more.
  void holdMap();
  /// Retires the key frames that have left the window and are older than `stamp`, oldest first. Retires none before the
  /// session has been aligned for some key frames, because its place in the map is not reliable until then. Returns
  /// their ids.
  std::vector<base::KeyFrameId> retire(base::Stamp stamp);
  /// Whether any key frame was retired. From then on the session stays aligned.
  bool hasRetired() const { return held_ > of_map_; }
  /// Number of key frames that are held; they come first in the map's order.
  std::size_t held() const { return held_; }

 private:
  bool mayRetire() const;
  void retireAnchor();
  void retire(base::VariableId gone, base::VariableId neighbour);

  Motion motion_;
  std::size_t size_;
  map::Map& map_;
  graph::Graph& graph_;
  std::size_t held_ = 0, of_map_ = 0;
};

}  // namespace omnimapper::mapper
