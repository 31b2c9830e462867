#pragma once

#include <omnimapper/live/Journal.h>

#include <array>
#include <cstdint>
#include <optional>

#include "Schedule.h"

namespace omnimapper::mapper {

/// How many of each length of time, to 5 % of it, however many there are.
class LatencyCounts {
 public:
  /// [s]
  void add(double latency);
  /// The length that the share `quantile` of all stays below; 0 without any.
  double quantile(double quantile) const;

 private:
  static constexpr std::size_t kSteps = 400;  // from a millisecond to three days
  std::array<std::uint64_t, kSteps> counts_{};
  std::uint64_t all_ = 0;
};

/// What is noted of a live run while it goes on.
struct LiveTrace {
  std::optional<live::JournalWriter> journal;
  LatencyCounts latencies;  ///< from an observation's stamp to its key frame in the map

  void note(live::JournalEvent::Kind kind, std::uint64_t number = 0) {
    if (journal) journal->add({kind, number});
  }
};

/// Takes what the workers have done, and notes when.
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
