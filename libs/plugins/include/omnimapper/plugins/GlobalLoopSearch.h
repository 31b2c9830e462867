#pragma once

#include <omnimapper/plugins/LoopSearch.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// One search for a loop that the windows of LoopSearch miss, as a job: where the estimate may be off by more than they
/// reach, or is sure of a place that looks otherwise, the newest scans are sought in all that was seen before. What is
/// found is a hypothesis like any other.
class GlobalLoopSearch {
 public:
  /// `newest`: the last metres, the newest last; `earlier`: all of the map in which they are sought; clouds of `label`.
  GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                   std::shared_ptr<const matching::ScanMatcher> matcher, std::string label,
                   std::vector<LoopSearch::Sight> newest, std::vector<LoopSearch::Sight> earlier);

  /// Empty if the robot is where the estimate has it; else a decision, and a hypothesis if a single place fits.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  bool isLost(const mapper::State& state, mapper::Decision& decision) const;
  double shareThatFits(const std::vector<LoopSearch::Sight>& near, const mapper::State& state) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::string label_;
  std::vector<LoopSearch::Sight> newest_, earlier_;
};

}  // namespace omnimapper::plugins
