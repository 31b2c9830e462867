#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "LoopSearch.h"

namespace omnimapper::plugins {

/// A search for the span of the trajectory that slipped, as a job. Refused closures that agree with one another, but
/// not with the map, say how far its end is off; what the motion of each single span would have to be if it alone were
/// wrong follows from them. The span whose scans gain most overlap by the motion that the closures require takes that
/// motion. If no scans confirm one, and the scans of a single span do not fit its odometry either, the motion follows
/// from the closures, with the uncertainty of the map between them.
class SlipSearch {
 public:
  /// `refused`: closures by scans that do not act. `trajectory`: what was seen at each key frame of the map, in order;
  /// an empty scan where that was nothing.
  SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
             std::vector<LoopSearch::KeyScan> trajectory);

  /// Empty if no two of them agree; else a decision of the kind kSlip, with the new motion if it is accepted. It is of
  /// another kind if no slip can explain them.
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
  static mapper::RelativeMotion withTheRest(mapper::RelativeMotion motion, const map::KeyFrame& before,
                                            const map::KeyFrame& after, const mapper::State& state);
  mrpt::math::TPose2D motion(std::size_t from, std::size_t to, const mapper::State& state) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::vector<base::FactorId> refused_;
  std::vector<LoopSearch::KeyScan> trajectory_;
};

/// Kind of the decision, and note of the factor that replaces what was measured.
inline constexpr char kSlip[] = "slip";
/// Numbers of an accepted one.
inline constexpr char kSlippedBy[] = "slipped by [m]", kSlippedByAngle[] = "slipped by [deg]";

}  // namespace omnimapper::plugins
