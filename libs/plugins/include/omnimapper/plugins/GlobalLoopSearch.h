#pragma once

#include <omnimapper/plugins/KnownPlaces.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// One search for a loop that the windows of LoopSearch miss, as a job: where the estimate may be off by more than they
/// reach, or is sure of a place that looks otherwise, the newest scans are sought in all that was seen before. What is
/// found is a hypothesis like any other.
class GlobalLoopSearch {
 public:
  /// `newest`: the last metres, the newest last; `earlier`: all of the map that is old enough for a loop; `places`:
  /// placesToLoopTo() as it was then or somewhat before; clouds of `label`.
  /// `on_new_ground`: search even where the estimate is sure to be where nothing was seen before.
  GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                   std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const KnownPlaces> places,
                   std::string label, std::vector<LoopSearch::Sight> newest, std::vector<LoopSearch::Sight> earlier,
                   bool on_new_ground);

  /// Empty if the robot is where the estimate has it; else a decision, and a hypothesis if a single place fits.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  bool isLost(const mapper::State& state, mapper::Decision& decision) const;
  double shareThatFits(const std::vector<LoopSearch::Sight>& near, const mapper::State& state) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::shared_ptr<const KnownPlaces> places_;
  std::string label_;
  std::vector<LoopSearch::Sight> newest_, earlier_;
  bool on_new_ground_;
};

/// What such searches look in: `earlier` as it lies in `map`, which has key frames.
std::shared_ptr<const KnownPlaces> placesToLoopTo(map::Map map, const std::string& label,
                                                  const std::vector<LoopSearch::Sight>& earlier,
                                                  std::shared_ptr<const matching::ScanMatcher> matcher);

}  // namespace omnimapper::plugins
