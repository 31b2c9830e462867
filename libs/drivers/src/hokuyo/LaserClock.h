#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>

namespace omnimapper::drivers {

/// Host time of the messages of a laser that stamps them by a clock of its own, of 24 bits of milliseconds, which
/// begins anew after 4.7 hours and runs a little fast or slow. The shortest latency is taken for none.
class LaserClock {
 public:
  /// Of the next message. Later than that of the message before.
  base::Stamp stampOf(std::uint32_t device_ms, base::Stamp arrival);

 private:
  void correctDrift(base::Duration lag, base::Stamp arrival);

  int messages_ = 0;
  std::uint32_t device_ms_ = 0;
  base::Stamp expected_;  // of the last message, by the laser's clock alone
  base::Stamp last_;
  base::Duration shortest_lag_{};  // of those since then
  base::Stamp since_;
};

}  // namespace omnimapper::drivers
