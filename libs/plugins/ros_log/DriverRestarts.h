#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "Plan.h"

namespace omnimapper::ros {

/// Finds where drivers started anew, by the numbers in the headers of ROS 1, which then begin again: what a driver
/// measures from its start jumps there. ROS 2 has no such numbers; its restarts show only in stamps that jump.
class DriverRestarts {
 public:
  /// Takes the next message of a sensor in the order of recording.
  void see(const SensorKey& sensor, const Header& header, std::int64_t recorded);
  /// A sentence for each sensor whose numbers begin again.
  std::vector<std::string> doubts(const Plan& plan) const;

 private:
  struct Seen {
    std::int64_t last = -1;  // number
    std::uint64_t messages = 0, restarts = 0;
    std::int64_t first_time = 0, first_restart = 0;  // of recording [ns]
  };
  std::map<SensorKey, Seen> seen_;
};

}  // namespace omnimapper::ros
