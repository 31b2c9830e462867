#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/SensorSection.h>

#include <cstddef>
#include <deque>

namespace omnimapper::live {

/// Converts the stamps of one driver to host time. If the driver uses another clock than the host, the offset between
/// the two clocks is estimated on the assumption that the shortest latency of an observation is zero. If the true
/// shortest latency is known, the key clock_offset_s can correct the estimate for it.
class SensorClock {
 public:
  /// An observation whose stamp differs from its arrival by more than `max_off` [s] is assumed to be stamped by another
  /// clock.
  SensorClock(const SensorOptions& options, double max_off) : options_(options), max_off_(max_off) {}

  /// The host time of an observation that arrived at `arrival`. Without a valid stamp, this is the time of arrival.
  base::Stamp corrected(base::Stamp stamp, base::Stamp arrival);
  /// [s] that is added to the driver's stamps now, clock_offset_s included.
  double offset() const { return options_.clock_offset + offset_; }
  /// How often a new offset of the driver's clock was found, the first one included.
  std::size_t jumps() const { return jumps_; }

 private:
  bool hasJumped(double off) const;

  SensorOptions options_;
  double max_off_;
  double offset_ = 0;  // [s] host's clock minus the driver's
  struct Arrival {
    base::Stamp arrival;
    double off;  // [s] arrival minus stamp
  };
  std::deque<Arrival> newest_;  // the last ten, or all of the last 5 s if these are more
  bool is_new_ = true;          // true until ten observations have come
  base::Stamp last_arrival_{}, last_given_{};
  std::size_t jumps_ = 0;
};

}  // namespace omnimapper::live
