#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/SensorSection.h>

#include <cstddef>
#include <deque>

namespace omnimapper::live {

/// Converts the stamps of one driver to host time. If the driver uses another clock, its offset is estimated on the
/// assumption that the shortest latency of its observations is zero; the error of the offset is this latency, which
/// clock_offset_s can correct.
class SensorClock {
 public:
  /// A stamp that differs from its arrival by more than `max_off` [s] is taken to be by another clock.
  SensorClock(const SensorOptions& options, double max_off) : options_(options), max_off_(max_off) {}

  /// The host time of an observation that arrived at `arrival`. Without a valid stamp it is that of the arrival.
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
  std::deque<Arrival> newest_;  // the last ten, or those of the last seconds
  bool is_new_ = true;          // until there were ten
  base::Stamp last_arrival_{}, last_given_{};
  std::size_t jumps_ = 0;
};

}  // namespace omnimapper::live
