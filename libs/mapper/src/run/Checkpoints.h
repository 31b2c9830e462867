#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/View.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>

namespace omnimapper::mapper {

/// Writes the map from time to time while it grows, in a separate thread and from a copy that shares unchanged data.
class Checkpoints {
 public:
  /// `period` [s]; 0 writes no checkpoints.
  Checkpoints(std::string path, double period) : path_(std::move(path)), period_(period) {}
  /// Waits for a checkpoint that is being written.
  ~Checkpoints();
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// Starts to write a checkpoint if one is due and the last is finished. Returns a sentence if the last could not be
  /// written, else an empty string.
  std::string offer(const View& view);
  /// Must be called at the end of the run: removes the checkpoint that it wrote if the file `map` is there and younger.
  void removeFor(const std::string& map);
  /// Number of checkpoints written.
  std::size_t count() const { return count_; }

 private:
  std::string finished();

  std::string path_;
  std::chrono::duration<double> period_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::unique_ptr<const Snapshot>
      copy_;  // the copy being written; created and destroyed by the thread that changes the map
  std::future<void> written_;
  std::size_t count_ = 0;
};

}  // namespace omnimapper::mapper
