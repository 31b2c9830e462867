#pragma once

#include <omnimapper/check/LogFacts.h>

#include <utility>
#include <vector>

namespace omnimapper::check {

/// The stamps of all sensors together, in order of arrival.
class StreamClock {
 public:
  void add(base::Stamp stamp);
  /// Newest stamp so far, since the clock was last set back; "no stamp" before the first.
  base::Stamp newest() const { return newest_; }
  /// Last stamp before the latest pause of all sensors of a minute or more; "no stamp" if there was none.
  base::Stamp beforePause() const { return before_pause_; }

 private:
  base::Stamp newest_, before_pause_;
};

/// Statistics on the stamps of one sensor.
class StampStatistics {
 public:
  /// The stamp must have been added to `clock` before.
  void add(base::Stamp stamp, const StreamClock& clock);
  StampFacts facts() const;
  /// The pauses that facts() counts as gaps: the stamps before and after each.
  std::vector<std::pair<base::Stamp, base::Stamp>> gaps() const;

 private:
  struct Step {
    base::Stamp begin;
    float seconds;
  };
  void addStep(double step, const StreamClock& clock);
  /// Forward steps, including leaps of all sensors if the log was recorded by distance, where these are pauses.
  std::vector<Step> pauses() const;
  double stepQuantile(double part) const;
  double period() const;
  bool isByDistance() const;

  StampFacts facts_;
  base::Stamp previous_;
  std::vector<base::Stamp> stamps_;
  std::vector<Step> steps_;  // forward, without leaps_
  std::vector<Step> leaps_;  // forward by a minute or more, with all other sensors
};

/// A stamp farther behind than this is of a clock that was set back, not of a late observation [s].
constexpr double kJumpBack = 10;

}  // namespace omnimapper::check
