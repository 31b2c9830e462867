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

/// Reads another source ahead in a separate thread, so that reading and decompressing go on while observations are
/// processed. Observations and their order stay the same. The thread waits when it has read as far ahead as the limits
/// allow; it then holds one more observation.
class ReadAhead : public ObservationSource {
 public:
  /// The size of an observation is the bytes that were read from the log for it plus those of its pixels and points in
  /// memory.
  static constexpr QueueLimits kLimits{1000, std::size_t{64} << 20};

  /// `inner` must not be null. While next() waits, it calls `stop` in its own thread; if `stop` returns true, next()
  /// returns null, and the ending of the report stays open.
  explicit ReadAhead(std::unique_ptr<ObservationSource> inner, std::function<bool()> stop = {},
                     QueueLimits limits = kLimits);
  /// Interrupts the inner source and waits until the thread, which does not read on, has ended.
  ~ReadAhead() override;
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Rethrows an exception of the inner source at the place in the stream where it was thrown; the stream ends there.
  mrpt::obs::CObservation::Ptr next() override;
  /// Progress at the observation that was handed out last. May be called from any thread.
  double progress() const override;
  /// Report at the observation that was handed out last, or at the end. May be called from any thread.
  SourceReport report() const override;
  void interrupt() override;

 private:
  struct Place {
    SourceReport report;
    double progress = 0;
  };
  struct Item {
    mrpt::obs::CObservation::Ptr observation;  // null: the end
    Place place;                               // state of the inner source after the observation
    std::exception_ptr error;                  // instead of an observation
  };
  Place innerPlace() const { return {inner_->report(), inner_->progress()}; }
  void read(std::uint64_t bytes_before);

  std::unique_ptr<ObservationSource> inner_;  // read by the thread only, once it runs
  std::function<bool()> stop_;
  BoundedQueue<Item> queue_;
  mutable std::mutex place_mutex_;
  Place place_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace omnimapper::source
