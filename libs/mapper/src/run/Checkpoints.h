#pragma once

#include <omnimapper/derived/SnapshotWriter.h>
#include <omnimapper/plugin/View.h>

#include <cstddef>
#include <string>

namespace omnimapper::mapper {

/// Writes the map from time to time while it grows.
class Checkpoints {
 public:
  /// `period` [s]; 0 writes no checkpoints.
  Checkpoints(std::string path, double period);

  /// Starts to write a checkpoint if one is due and the last is finished. Returns a sentence if the last could not be
  /// written, else an empty string.
  std::string offer(const View& view);
  /// Must be called at the end of the run: removes the checkpoint that it wrote if the file `map` is there and younger.
  void removeFor(const std::string& map);
  /// Number of checkpoints written.
  std::size_t count() const { return writer_.count(); }

 private:
  std::string path_;
  derived::SnapshotWriter writer_;
};

}  // namespace omnimapper::mapper
