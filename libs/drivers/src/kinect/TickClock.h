#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/SensorClock.h>

#include <cstdint>
#include <optional>

namespace omnimapper::drivers {

/// The time that a Kinect writes beside its images: ticks of 60 MHz in 32 bits, which begin anew every 71.6 s. In the
/// host's time it has the shortest latency seen so far, instead of that of each image.
class TickClock {
 public:
  struct Time {
    double seconds = 0;  ///< since the first; of all images of the device by one clock
    base::Stamp stamp;   ///< of the host's clock
  };
  /// Of an image that arrived then, in the order of arrival. A device whose ticks begin anew without having come to
  /// their end is taken up from there.
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
