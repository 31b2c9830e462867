#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/RelativeMotion.h>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace omnimapper::mapper {

struct TriggerOptions {
  bool every_observation = false;
  double distance = 0.4;                                       ///< [m]
  double angle = 20.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double period = 0;                                           ///< [s]; 0: time alone never makes a key frame
  double period_without_odometry = 0.2;                        ///< [s]

  static const base::OptionTable<TriggerOptions>& table();
};

/// Decides which observations get a pose of their own. It uses only the stamp and the motion that pose plugins measured
/// (thesis 5.3.2.1), never the estimate, so that the decision does not depend on the graph. Each sensor label has its
/// own state.
class Trigger {
 public:
  explicit Trigger(const TriggerOptions& options) : options_(options) {}

  /// Motion over a time span, measured by the continuous sources; none if they do not cover the span.
  using MotionBetween = std::function<std::optional<RelativeMotion>(base::Stamp begin, base::Stamp end)>;

  /// Whether the observation of that label and stamp gets a pose; the first of a label does. Call it in order of stamp.
  bool fires(const std::string& label, base::Stamp stamp, const MotionBetween& motion);
  /// As fires(), but for an observation that is older than the last one of its label. The observation gets a pose if it
  /// is as far from the triggered observations before and after it as triggered observations must be from each other.
  bool firesLate(const std::string& label, base::Stamp stamp, const MotionBetween& motion);
  /// Drops the state that only late observations before `stamp` need; firesLate() must not be called for such
  /// observations any more.
  void forgetBefore(base::Stamp stamp);

 private:
  /// State of a label since its last triggered observation.
  struct Since {
    base::Stamp fired, newest;
    std::optional<mrpt::poses::CPose3D> motion;  // from fired to newest; none if a part of the span is not covered
    std::set<base::Stamp> all_fired = {};        // as far back as late observations may be
  };
  bool isDue(const Since& since) const;

  TriggerOptions options_;
  std::map<std::string, Since> labels_;
};

}  // namespace omnimapper::mapper
