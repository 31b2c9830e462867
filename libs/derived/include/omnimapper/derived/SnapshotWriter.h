#pragma once

#include <omnimapper/plugin/View.h>

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>

namespace omnimapper::derived {

/// Writes something of a map from time to time while the map grows, in a separate thread and from a copy that shares
/// unchanged data. The thread that changes the map never waits for it.
class SnapshotWriter {
 public:
  /// Called in another thread, one call at a time. May throw.
  using Write = std::function<void(const mapper::State&)>;

  /// `period` [s] from one beginning to the next at the least; 0 writes nothing. At most `share` of the time is spent
  /// on it: what takes long is done less often.
  SnapshotWriter(Write write, double period, double share = 1)
      : write_(std::move(write)), period_(period), share_(share) {}
  /// Waits for what is being written.
  ~SnapshotWriter();
  SnapshotWriter(const SnapshotWriter&) = delete;
  SnapshotWriter& operator=(const SnapshotWriter&) = delete;

  /// Begins to write if it is due, the last is finished, and the map has a key frame. Returns why the last failed, if
  /// it did, else an empty string.
  std::string offer(const mapper::View& view);
  /// Waits for what is being written. Returns as offer() does.
  std::string wait();
  /// How often it was written.
  std::size_t count() const { return count_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::string finished();

  Write write_;
  std::chrono::duration<double> period_;
  double share_;
  Clock::time_point next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(period_);
  std::unique_ptr<const mapper::Snapshot>
      copy_;                     // the copy being written; created and destroyed by the thread that changes the map
  std::future<double> written_;  // [s] that it took
  std::size_t count_ = 0;
};

}  // namespace omnimapper::derived
