#pragma once

#include <omnimapper/check/LogFacts.h>

#include <vector>

namespace omnimapper::check {

/// Counts the stamps of one sensor.
class StampTally {
 public:
  /// `newest` is the newest stamp of all sensors so far, or "no stamp".
  void add(base::Stamp stamp, base::Stamp newest);
  StampFacts facts() const;

 private:
  void addStep(double step);

  StampFacts facts_;
  base::Stamp previous_;
  std::vector<base::Stamp> stamps_;
  std::vector<float> steps_;  // [s] forward, jumps left out
};

/// Farther than this behind is a clock that was set back, not an observation that came late [s].
constexpr double kJumpBack = 10;

}  // namespace omnimapper::check
