#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "LoopSearch.h"

namespace omnimapper::plugins {

/// A job that searches for the span of the trajectory, from one key frame to the next, in which the odometry slipped.
/// Refused closures that agree with one another, but not with the map, determine the error at the end of the
/// trajectory. From this error follows the motion that each span must have had if only that span was wrong. If the
/// scans before and after a span fit better at such a motion, the span whose scans gain most overlap gets the motion at
/// which they fit. Otherwise, if there is exactly one span whose scans do not fit at its present motion either, this
/// span gets the motion that follows from the closures, with a fixed uncertainty for the errors of the map.
class SlipSearch {
 public:
  /// `refused`: the closures found by global searches that the consistency test refused. `trajectory`: the scan of each
  /// key frame of the map, in order; for a key frame without a scan, an empty one.
  SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
             std::vector<LoopSearch::KeyScan> trajectory);

  /// Empty if no two closures agree. Otherwise a decision of kind kSlip, with the new motion if the decision is
  /// accepted; the decision is of another kind if no slip can explain the closures.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// A closure: the place and the later key frame, as indices of the trajectory, and the motion between them.
  struct Closure {
    std::size_t place, newest;
    mrpt::math::TPose2D place_from_newest;
  };
  struct Span;
  struct SpanCorrection;
  std::vector<Closure> agreeing(const mapper::State& state) const;
  std::vector<Closure> closures(const mapper::State& state) const;
  std::vector<Span> spans(const std::vector<Closure>& agreeing, const mapper::State& state) const;
  void compare(std::vector<Span>& spans, const mapper::State& state) const;
  std::optional<SpanCorrection> correctedByScans(std::vector<Span> spans, const mapper::State& state) const;
  static std::optional<SpanCorrection> correctedByClosures(std::vector<Span> spans);
  matching::ScanWithNormals seenBefore(const Span& span, const mapper::State& state) const;
  matching::ScanWithNormals seenAfter(const Span& span, const mapper::State& state) const;
  static mapper::RelativeMotion withHeightAndTilt(mapper::RelativeMotion motion, const map::KeyFrame& before,
                                                  const map::KeyFrame& after, const mapper::State& state);
  mrpt::math::TPose2D motion(std::size_t from, std::size_t to, const mapper::State& state) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::vector<base::FactorId> refused_;
  std::vector<LoopSearch::KeyScan> trajectory_;
};

/// Kind of the decision, and note of the factor that replaces the measured motion.
inline constexpr char kSlip[] = "slip";
/// Names of the numbers of an accepted decision.
inline constexpr char kSlippedBy[] = "slipped by [m]", kSlippedByAngle[] = "slipped by [deg]";

}  // namespace omnimapper::plugins
