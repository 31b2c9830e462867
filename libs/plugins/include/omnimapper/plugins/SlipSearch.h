#pragma once

#include <omnimapper/plugins/LoopSearch.h>

#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::plugins {

/// A search for the span of the trajectory that slipped, as a job. Refused closures that agree with one another, but
/// not with the map, say how far its end is off; what the motion of each single span would have to be if it alone were
/// wrong follows from them. Where the scans before and after a span fit one another in that way, and better than as the
/// map has them, that motion takes the place of the one that was measured.
class SlipSearch {
 public:
  /// `refused`: closures by scans that do not act. `drive`: what was seen from the first of their places on, in order.
  SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
             std::vector<LoopSearch::Sight> drive);

  /// Empty if no two of them agree; else a decision of the kind kSlip, with the new motion if it is accepted.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// A closure: the place and the later key frame, as indices of the drive, and the motion between them.
  struct Closure {
    std::size_t place, newest;
    mrpt::math::TPose2D place_from_newest;
  };
  struct Span;
  struct Mended;
  std::vector<Closure> agreeing(const mapper::State& state) const;
  std::vector<Closure> closures(const mapper::State& state) const;
  std::vector<Span> spans(const std::vector<Closure>& agreeing, const mapper::State& state) const;
  void compare(std::vector<Span>& spans, const mapper::State& state) const;
  std::optional<Mended> bornOutByScans(std::vector<Span> spans, const mapper::State& state) const;
  std::optional<Mended> bornOutByNothing(std::vector<Span> spans, const mapper::State& state) const;
  matching::PlanarScan seenBefore(const Span& span, const mapper::State& state) const;
  matching::PlanarScan seenAfter(const Span& span, const mapper::State& state) const;
  base::VariableId poseOf(std::size_t i, const mapper::State& state) const;
  mrpt::math::TPose2D motion(std::size_t from, std::size_t to, const mapper::State& state) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::vector<base::FactorId> refused_;
  std::vector<LoopSearch::Sight> drive_;
};

/// Kind of the decision, and note of the factor that replaces what was measured.
inline constexpr char kSlip[] = "slip";
/// Numbers of an accepted one.
inline constexpr char kSlippedBy[] = "slipped by [m]", kSlippedByAngle[] = "slipped by [deg]";

}  // namespace omnimapper::plugins
