#include "DriverRestarts.h"

#include <omnimapper/base/Numbers.h>

namespace omnimapper::ros {

namespace {

// Messages that overtake each other are a few numbers apart; those of a new driver begin near zero.
bool beginsAgain(std::int64_t number, std::int64_t last) {
  constexpr std::int64_t kOvertaking = 10;
  return 2 * number < last && last - number > kOvertaking;
}

}  // namespace

void DriverRestarts::see(const SensorKey& sensor, const Header& header, std::int64_t recorded) {
  constexpr std::size_t kMostSensors = 1000;  // a log can have any number of frames
  if (header.number < 0 || (seen_.size() >= kMostSensors && seen_.count(sensor) == 0)) return;
  Seen& seen = seen_[sensor];
  if (seen.messages++ == 0) seen.first_time = recorded;
  if (beginsAgain(header.number, seen.last) && seen.restarts++ == 0) seen.first_restart = recorded;
  seen.last = header.number;
}

std::vector<std::string> DriverRestarts::doubts(const Plan& plan) const {
  constexpr double kNanosecond = 1e-9;            // [s]
  constexpr std::uint64_t kOftenPerRestart = 10;  // messages; no driver starts anew so often
  std::vector<std::string> doubts;
  for (const auto& [sensor, seen] : seen_) {
    if (seen.restarts == 0) continue;
    const std::string who = "'" + plan.labelOf(sensor) + "': the numbers in its headers begin again " +
                            base::counted(seen.restarts, "time") + ", first " +
                            base::fixed(kNanosecond * static_cast<double>(seen.first_restart - seen.first_time), 1) +
                            " s after its first message: ";
    doubts.push_back(who + (kOftenPerRestart * seen.restarts > seen.messages
                                ? "several programs publish its topic with the same frame, and they are taken for one "
                                  "sensor"
                                : "its driver started anew, so what it measures from its start may jump there"));
  }
  return doubts;
}

}  // namespace omnimapper::ros
