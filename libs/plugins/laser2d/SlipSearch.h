#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "LoopSearch.h"

namespace omnimapper::plugins {

/// A job that searches for the span of the trajectory in which the odometry slipped. Refused closures that agree with
/// one another, but not with the map, determine the error at the end of the trajectory. From it follows the motion that
/// each span must have had if only that span was wrong. The span whose scans gain most overlap at that motion gets it.
/// If scans confirm no span, but those of exactly one span do not fit its odometry either, that span gets the motion
/// that follows from the closures, with the uncertainty of the map between them.
class SlipSearch {
 public:
  /// `refused`: refused closures by scans. `trajectory`: the scan of each key frame of the map, in order; an empty one
  /// where there is none.
  SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
             std::vector<LoopSearch::KeyScan> trajectory);

  /// Empty if no two closures agree; else a decision of kind kSlip, with the new motion if it is accepted. The decision
  /// is of another kind if no slip can explain the closures.
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
