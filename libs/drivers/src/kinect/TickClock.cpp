#include <omnimapper/drivers/TickClock.h>

#include <cmath>

namespace omnimapper::drivers {

live::SensorClock TickClock::ofHost() {
  constexpr double kLargestLatency = 0.5;  // [s] more than twice the time that FreenectDevice buffers
  return live::SensorClock(live::SensorOptions(), kLargestLatency);
}

TickClock::Time TickClock::at(std::uint32_t ticks, base::Stamp arrival) {
  constexpr double kTick = 1 / 60e6, kRound = 4294967296 * kTick;  // [s]
  constexpr double kBack = 0.2, kAhead = 5;  // [s] more than the order of images or a busy host explains
  double seconds = 0;
  if (last_) {
    const double elapsed = base::secondsBetween(last_->arrival, arrival);
    double step = static_cast<std::uint32_t>(ticks - last_->ticks) * kTick;
    step += kRound * std::round((elapsed - step) / kRound);
    if (step < -kBack || std::abs(step - elapsed) > kAhead) {
      step = elapsed;
      host_ = ofHost();
    }
    seconds = last_->seconds + step;
  }
  last_ = Last{ticks, arrival, seconds};
  constexpr double kAnyTime = 1e6;  // [s] since 1970, so that images from before the first one have a stamp, too
  return {seconds, host_.corrected(base::stampFromUnix(kAnyTime + seconds), arrival)};
}

}  // namespace omnimapper::drivers
