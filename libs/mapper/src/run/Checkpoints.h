#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/View.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Writes the map from time to time while it grows, in a thread of its own, on a copy that shares what does not change.
class Checkpoints {
 public:
  /// `period` [s]: 0 writes none.
  Checkpoints(std::string path, double period) : path_(std::move(path)), period_(period) {}
  /// Waits for one that is being written.
  ~Checkpoints();
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// Begins to write one if it is time for it and the last is done. Gives a sentence if that could not be written.
  std::string offer(const View& view);
  /// The run is over: a checkpoint that it wrote is not needed any more if there is the map itself, younger, as `map`.
  void removeFor(const std::string& map);
  /// Writes done.
  std::size_t count() const { return count_; }

 private:
  struct Copy {
    map::Map map;
    graph::Graph graph;
    std::vector<map::MapSection> sections;
  };
  std::string finished();

  std::string path_;
  std::chrono::duration<double> period_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::unique_ptr<const Copy> copy_;  // that is being written; made and destroyed by the thread that changes the map
  std::future<void> written_;
  std::size_t count_ = 0;
};

}  // namespace omnimapper::mapper
