#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>

namespace omnimapper::drivers {

/// Converts the stamps of a laser's messages to host time. The laser's clock counts milliseconds in 24 bits, so it
/// wraps after 4.7 hours, and it is a little fast or slow. The shortest latency is assumed to be zero.
class LaserClock {
 public:
  /// The stamp of the next message, which is later than that of the message before.
  base::Stamp stampOf(std::uint32_t device_ms, base::Stamp arrival);

 private:
  void correctDrift(base::Duration lag, base::Stamp arrival);

  int messages_ = 0;
  std::uint32_t device_ms_ = 0;
  base::Stamp expected_;  // host time of the last message, by the laser's clock alone
  base::Stamp last_;
  base::Duration shortest_lag_{};  // of the messages since `since_`
  base::Stamp since_;
};

}  // namespace omnimapper::drivers
