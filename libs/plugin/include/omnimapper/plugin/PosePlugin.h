#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/perception/Blackboard.h>
#include <omnimapper/plugin/RelativeMotion.h>
#include <omnimapper/plugin/Verdict.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// A continuous pose source: it returns the motion over any span that it covers (thesis 5.2.2.1, 5.3.4).
class PosePlugin {
 public:
  virtual ~PosePlugin() = default;
  enum class Taken {
    not_mine,  ///< of another kind or sensor
    taken,
    unusable,  ///< of the right kind, but not finite, or its time runs backwards
  };
  /// Takes an observation, never null, into the plugin's history if it is of the right kind. Called in order of
  /// arrival, which may differ from the order of stamps. A source may keep the pointer for later: the observation is
  /// never changed.
  virtual Taken add(const mrpt::obs::CObservation::ConstPtr& observation) = 0;
  struct Span {
    base::Stamp begin, end;
  };
  /// The time span for which the last add() brought new information; none if it brought none. Key frames in the span
  /// that were linked with older information are linked again.
  virtual std::optional<Span> news() const { return std::nullopt; }
  /// Called when everything stamped up to `stamp` has arrived, except late data, and before motions up to `stamp` are
  /// requested. Heavy work that needs the order of stamps is done here.
  virtual void processUntil(base::Stamp /*stamp*/) {}
  /// What perception gets of an observation that processUntil() has processed: the observation itself; a copy without
  /// what the source found to be of no use for a map, such as people; or null if nothing of it is of use.
  virtual mrpt::obs::CObservation::ConstPtr usablePart(const mrpt::obs::CObservation::ConstPtr& observation) const {
    return observation;
  }
  /// Puts on the blackboard what processUntil() has made of the observation just now and perception can use again.
  virtual void share(const mrpt::obs::CObservation& /*observation*/, perception::Blackboard& /*board*/) const {}
  /// Motion from `begin` to `end` (begin <= end); none if the span is not covered.
  /// Spans must add up: cov(a, c) is the sum of cov(a, b), transformed to the frame at c, and cov(b, c). A span can
  /// then be split without a change of its covariance.
  virtual std::optional<RelativeMotion> between(base::Stamp begin, base::Stamp end) const = 0;
  /// The time up to which the source can return motions; none before it has data.
  virtual std::optional<base::Stamp> coveredUntil() const = 0;
  /// A fallback is used only for a span that no other source covers, and the queue never waits for it. Of several
  /// fallbacks that cover a span, only the first in the order of the INI is used.
  virtual bool isFallback() const { return false; }
  /// Whether the motions are measured. A source that only guesses motions is not asked whether the base has moved.
  virtual bool measures() const { return true; }
  /// Warnings for the user at the end of a run: sentences that name the sensor and the remedy.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// The evidence of this source for or against the map, at the end of a run.
  virtual std::vector<Evidence> evidence() const { return {}; }
  /// Called when spans before `stamp` will not be requested any more.
  virtual void forgetBefore(base::Stamp /*stamp*/) {}
};

}  // namespace omnimapper::mapper
