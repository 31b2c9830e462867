#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/SensorClock.h>

#include <cstdint>
#include <optional>

namespace omnimapper::drivers {

/// Converts the stamps of a Kinect's images to host time. They are ticks of 60 MHz in 32 bits, which wrap every 71.6 s.
/// The host time is later by the shortest latency so far, instead of by that of each image.
class TickClock {
 public:
  struct Time {
    double seconds = 0;  ///< since the first image; one clock for all images of the device
    base::Stamp stamp;   ///< of the host's clock
  };
  /// The time of an image that arrived at `arrival`; to be called in the order of arrival. If the ticks restart without
  /// having wrapped, time goes on from there.
  Time at(std::uint32_t ticks, base::Stamp arrival);

 private:
  static live::SensorClock ofHost();

  struct Last {
    std::uint32_t ticks;
    base::Stamp arrival;
    double seconds;
  };
  std::optional<Last> last_;
  live::SensorClock host_ = ofHost();
};

}  // namespace omnimapper::drivers
