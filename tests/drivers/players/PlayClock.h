#pragma once

#include <omnimapper/base/Stamp.h>

#include <functional>
#include <string>

namespace omnimapper::players {

/// Called often during a wait; true ends it early.
using Stop = std::function<bool()>;

/// Converts stamps of a log to times of this machine's clock (UTC) at which they are played, `pace` times as fast as
/// recorded.
class PlayClock {
 public:
  /// `pace` > 0.
  PlayClock(base::Stamp log_start, base::Stamp host_start, double pace);

  base::Stamp hostTime(base::Stamp log) const;
  base::Stamp hostStart() const { return host_start_; }

 private:
  base::Stamp log_start_, host_start_;
  double pace_;
};

/// Waits for that time of this machine's clock. Returns false within 20 ms if it is stopped before.
bool waitUntil(base::Stamp host, const Stop& stop);

/// Rewrites a trajectory file (TUM, or MRPT's ground truth) as TUM, with the log's stamps replaced by those of the
/// clock. Throws as eval::readTrajectory() and eval::writeTum().
void shiftTrajectory(const std::string& from, const std::string& to, const PlayClock& clock);

}  // namespace omnimapper::players
