#pragma once

#include <omnimapper/check/LogFacts.h>

#include <utility>
#include <vector>

namespace omnimapper::check {

/// The stamps of all sensors together, in order of arrival.
class StreamClock {
 public:
  void add(base::Stamp stamp);
  /// Of all so far, unless the clock was set back since; "no stamp" before the first.
  base::Stamp newest() const { return newest_; }
  /// The stamp before which all sensors paused when last they did so for a minute or more; "no stamp" if they never
  /// did.
  base::Stamp beforePause() const { return before_pause_; }

 private:
  base::Stamp newest_, before_pause_;
};

/// Counts the stamps of one sensor.
class StampStatistics {
 public:
  /// `clock` has been given this stamp before.
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
  /// Forward steps; those by which the clock may have been set only where they are taken for pauses.
  std::vector<Step> pauses() const;
  double stepQuantile(double part) const;
  double period() const;
  bool isByDistance() const;

  StampFacts facts_;
  base::Stamp previous_;
  std::vector<base::Stamp> stamps_;
  std::vector<Step> steps_;  // forward, the following left out
  std::vector<Step> leaps_;  // forward by a minute or more, with all other sensors
};

/// Farther than this behind is a clock that was set back, not an observation that came late [s].
constexpr double kJumpBack = 10;

}  // namespace omnimapper::check
