#pragma once

#include <mutex>
#include <optional>

#include "PlayClock.h"

namespace omnimapper::players {

/// When the players of one log begin together: at a given time, or 0.1 s after the hosts of all of them are there.
/// For several threads.
class CommonStart {
 public:
  CommonStart(int players, base::Stamp log_start, double pace, std::optional<base::Stamp> host_start = std::nullopt);

  /// Called once by each player whose host is there.
  void ready();
  /// Empty while others are waited for.
  std::optional<PlayClock> clock() const;
  double pace() const { return pace_; }

 private:
  const base::Stamp log_start_;
  const double pace_;
  mutable std::mutex mutex_;
  int awaited_;
  std::optional<base::Stamp> host_start_;
};

}  // namespace omnimapper::players
