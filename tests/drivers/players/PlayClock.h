#pragma once

#include <omnimapper/base/Stamp.h>

#include <functional>
#include <string>

namespace omnimapper::players {

/// Asked often while something waits; true ends it early.
using Stop = std::function<bool()>;

/// When what a log has at a stamp happens on this machine's clock, UTC: `pace` times as fast as it was recorded.
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

/// Waits for that time of this machine's clock. Returns false if it was stopped before, within 20 ms.
bool waitUntil(base::Stamp host, const Stop& stop);

/// Writes a trajectory file (TUM, or MRPT's ground truth) anew as TUM, its stamps of the log replaced by those of the
/// clock. Throws as eval::readTrajectory() and eval::writeTum().
void shiftTrajectory(const std::string& from, const std::string& to, const PlayClock& clock);

}  // namespace omnimapper::players
