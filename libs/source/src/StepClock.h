#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <omnimapper/base/Stamp.h>

#include <optional>
#include <set>
#include <string>
#include <utility>

namespace omnimapper::source {

/// Replaces the stamps of a log whose clock stands still: one step each `step` seconds from the first stamp on, or from
/// 2001 if there is none. A step ends when a sensor, or an action, comes a second time.
class StepClock {
 public:
  /// With 0 all stamps stay as they are.
  explicit StepClock(double step) : step_(step) {}

  void stamp(mrpt::obs::CActionCollection& actions);
  void stamp(const mrpt::obs::CSensoryFrame& frame);
  void stamp(mrpt::obs::CObservation& observation);

 private:
  using Who = std::pair<std::string, std::string>;  // label and class; an action has neither
  static Who whoIs(const mrpt::obs::CObservation& observation);
  base::Stamp now(base::Stamp own);

  double step_;
  std::optional<base::Stamp> first_;
  std::int64_t steps_ = 0;
  std::set<Who> seen_;  // in this step
};

}  // namespace omnimapper::source
