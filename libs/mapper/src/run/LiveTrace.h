#pragma once

#include <omnimapper/live/Journal.h>

#include <array>
#include <cstdint>
#include <optional>

#include "Schedule.h"

namespace omnimapper::mapper {

/// Histogram of latencies with a relative resolution of 5 % and constant memory.
class LatencyCounts {
 public:
  /// Adds a latency [s].
  void add(double latency);
  /// The latency [s] below which the share `quantile` of all lies; 0 if there are none.
  double quantile(double quantile) const;

 private:
  static constexpr std::size_t kSteps = 400;  // bins from a millisecond to three days
  std::array<std::uint64_t, kSteps> counts_{};
  std::uint64_t all_ = 0;
};

/// The data recorded about a live run while it goes on.
struct LiveTrace {
  std::optional<live::JournalWriter> journal;
  LatencyCounts latencies;  ///< from the stamp of an observation to its key frame being in the map

  void note(live::JournalEvent::Kind kind, std::uint64_t number = 0) {
    if (journal) journal->add({kind, number});
  }
};

/// Uses the results of the workers as soon as they are done, and records this in the journal.
class LiveSchedule : public Schedule {
 public:
  explicit LiveSchedule(std::shared_ptr<LiveTrace> trace) : trace_(std::move(trace)) {}
  void mapped(base::Stamp stamp) override;

 private:
  bool takesBundleBeforeEnd(const FrameBundle& oldest, std::size_t waiting) override;
  bool takesJobBeforeEnd(bool is_due, bool is_done) override;

  std::shared_ptr<LiveTrace> trace_;
};

}  // namespace omnimapper::mapper
