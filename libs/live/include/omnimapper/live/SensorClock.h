#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/SensorSection.h>

#include <cstddef>
#include <deque>

namespace omnimapper::live {

/// Stamps of one driver in the time of the host. Where the driver's clock is another one, the shortest latency of its
/// observations counts as none: what remains of the offset's error is that latency, which clock_offset_s corrects.
class SensorClock {
 public:
  /// `max_off` [s]: what is farther from its arrival is by another clock.
  SensorClock(const SensorOptions& options, double max_off) : options_(options), max_off_(max_off) {}

  /// The time of an observation that arrived then. One without a stamp has the time of its arrival.
  base::Stamp corrected(base::Stamp stamp, base::Stamp arrival);
  /// [s] that is added to the driver's stamps now, clock_offset_s included.
  double offset() const { return options_.clock_offset + offset_; }
  /// How often the driver's clock was found elsewhere than it had been, its first time included.
  std::size_t jumps() const { return jumps_; }

 private:
  bool hasJumped(double off) const;

  SensorOptions options_;
  double max_off_;
  double offset_ = 0;  // [s] of the host's clock to the driver's
  struct Arrival {
    base::Stamp arrival;
    double off;  // [s] of it to the stamp
  };
  std::deque<Arrival> newest_;  // the last ten, or those of the last seconds
  bool is_new_ = true;          // until there were ten
  base::Stamp last_arrival_{}, last_given_{};
  std::size_t jumps_ = 0;
};

}  // namespace omnimapper::live
