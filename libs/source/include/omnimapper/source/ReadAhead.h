#pragma once

#include <omnimapper/source/BoundedQueue.h>
#include <omnimapper/source/ObservationSource.h>

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace omnimapper::source {

/// Reads another source ahead in a thread of its own, so that reading and decompressing go on while the observations
/// are worked on. Same observations, same order. The thread waits when as much as the limits allow has been read ahead,
/// and holds one observation more.
class ReadAhead : public ObservationSource {
 public:
  /// An observation counts with the bytes that were read from the log for it, and the pixels and points that it has
  /// in memory.
  static constexpr QueueLimits kLimits{1000, std::size_t{64} << 20};

  /// `stop` is asked, by the thread that calls next(), while that has to wait; if it is true, next() returns null with
  /// the report's ending still open. Never null: `inner`.
  explicit ReadAhead(std::unique_ptr<ObservationSource> inner, std::function<bool()> stop = {},
                     QueueLimits limits = kLimits);
  /// Interrupts the inner source and waits for the thread, which does not read on.
  ~ReadAhead() override;
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// What the inner source threw comes out in its place, and is the end.
  mrpt::obs::CObservation::Ptr next() override;
  /// As of the observation that was handed out last. From any thread.
  double progress() const override;
  /// As of the observation that was handed out last, or as of the end. From any thread.
  SourceReport report() const override;
  void interrupt() override;

 private:
  struct Place {
    SourceReport report;
    double progress = 0;
  };
  struct Item {
    mrpt::obs::CObservation::Ptr observation;  // null: the end
    Place place;                               // of the inner source after it
    std::exception_ptr error;                  // instead of an observation
  };
  Place innerPlace() const { return {inner_->report(), inner_->progress()}; }
  void read(std::uint64_t bytes_before);

  std::unique_ptr<ObservationSource> inner_;  // the thread's alone, once it runs
  std::function<bool()> stop_;
  BoundedQueue<Item> queue_;
  mutable std::mutex place_mutex_;
  Place place_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace omnimapper::source
