#pragma once

#include <mutex>
#include <optional>

#include "PlayClock.h"

namespace omnimapper::players {

/// The time at which the players of one log begin together: a given one, or 0.1 s after the hosts of all of them have
/// connected. Thread-safe.
class CommonStart {
 public:
  CommonStart(int players, base::Stamp log_start, double pace, std::optional<base::Stamp> host_start = std::nullopt);

  /// To be called once by each player when its host has connected.
  void ready();
  /// Empty while some hosts have not connected yet.
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
