#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/RelativeMotion.h>
#include <omnimapper/plugin/Verdict.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// A continuous pose source: it can tell the motion over any span it covers (thesis 5.2.2.1, 5.3.4).
class PosePlugin {
 public:
  virtual ~PosePlugin() = default;
  enum class Taken {
    not_mine,  ///< of another kind or sensor
    taken,
    unusable,  ///< of its kind, but not finite, or its time runs backwards
  };
  /// Takes an observation, never null, into its history if it is of its kind. Called in order of arrival, which need
  /// not be that of stamps. A source that works on it later keeps the pointer: nobody changes what it points to.
  virtual Taken add(const mrpt::obs::CObservation::ConstPtr& observation) = 0;
  struct Span {
    base::Stamp begin, end;
  };
  /// The span of time of which the last add() taught it something; none if there is none. Key frames in it that were
  /// linked by what was known before are linked anew.
  virtual std::optional<Span> news() const { return std::nullopt; }
  /// Everything stamped up to `stamp` has arrived, late data apart: what takes work and needs the order of stamps is
  /// done here. Called before motions up to there are asked for.
  virtual void processUntil(base::Stamp /*stamp*/) {}
  /// Motion from `begin` to `end` (begin <= end), none if the span is not covered.
  /// Additive: cov(a, c) = cov(a, b) transported + cov(b, c), so that a span may be split without gain or loss.
  virtual std::optional<RelativeMotion> between(base::Stamp begin, base::Stamp end) const = 0;
  /// Until when it can answer; none before it has data.
  virtual std::optional<base::Stamp> coveredUntil() const = 0;
  /// A fallback is asked only for a span that no other source covers, and never holds up the queue. Of several
  /// the first in the order of the INI that covers it answers alone.
  virtual bool isFallback() const { return false; }
  /// Whether it tells what it measured. One that only guesses is not asked whether the base has moved.
  virtual bool measures() const { return true; }
  /// What a user should know at the end of a run: sentences that name the sensor and the remedy.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// At the end of a run: what the source knows for or against the map.
  virtual std::vector<Evidence> evidence() const { return {}; }
  /// Spans before `stamp` will not be asked for any more.
  virtual void forgetBefore(base::Stamp /*stamp*/) {}
};

}  // namespace omnimapper::mapper
