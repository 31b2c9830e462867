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
  double period = 0;                                           ///< [s]; 0: time alone never triggers
  double period_without_odometry = 0.2;                        ///< [s]

  static const base::OptionTable<TriggerOptions>& table();
};

/// Decides which observations earn a pose of their own, from stamp and the motion that pose plugins measured alone
/// (thesis 5.3.2.1): never from the estimate, so that the decision does not depend on what the graph makes of it. Each
/// sensor label has its own state.
class Trigger {
 public:
  explicit Trigger(const TriggerOptions& options) : options_(options) {}

  /// Motion over a span by the continuous sources; none if they do not cover it.
  using MotionBetween = std::function<std::optional<RelativeMotion>(base::Stamp begin, base::Stamp end)>;

  /// Whether the observation of that label and stamp gets a pose. The first of a label does. Call in order of stamp.
  bool fires(const std::string& label, base::Stamp stamp, const MotionBetween& motion);
  /// The same of an observation that is older than the last of its label: it does if it is as far from the triggered
  /// ones before and after it as they are to be from each other.
  bool firesLate(const std::string& label, base::Stamp stamp, const MotionBetween& motion);
  /// No late observation before `stamp` will be asked about.
  void forgetBefore(base::Stamp stamp);

 private:
  /// What happened to a label since its last triggered observation.
  struct Since {
    base::Stamp fired, seen;
    std::optional<mrpt::poses::CPose3D> motion;  // from fired to seen; none if a part of it is not covered
    std::set<base::Stamp> all_fired = {};        // as far back as late ones may come
  };
  bool isDue(const Since& since) const;

  TriggerOptions options_;
  std::map<std::string, Since> labels_;
};

}  // namespace omnimapper::mapper
