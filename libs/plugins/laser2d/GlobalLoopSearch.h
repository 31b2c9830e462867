#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// One search for a loop that the windows of LoopSearch miss, as a job: where the estimate may be off by more than they
/// reach, or is sure of a place that looks otherwise, the newest scans are sought in all that was seen before. What is
/// found there is a hypothesis like any other; what is found within those windows is left to LoopSearch, which knows
/// single passes of the robot and is more exact.
class GlobalLoopSearch {
 public:
  /// `newest`: the last metres, the newest last; `earlier`: all of the map that is old enough for a loop; `places`:
  /// placesToLoopTo() as it was then or somewhat before; clouds of `label`.
  /// `on_new_ground`: search even where the estimate is sure to be where nothing was seen before.
  GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                   std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const ScanDatabase> places,
                   std::string label, std::vector<LoopSearch::KeyScan> newest, std::vector<LoopSearch::KeyScan> earlier,
                   bool on_new_ground);

  /// Empty if the robot is where the estimate has it; else a decision, and a hypothesis if a single place fits.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// Where the estimate has the robot, as far as that is known.
  struct Estimate {
    double uncertainty;  // [m] three standard deviations
    bool is_lost;        // it may be anywhere, or it is sure of ground that was seen before and looks otherwise
  };
  std::optional<Estimate> judged(const mapper::State& state, mapper::Decision& decision) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::shared_ptr<const ScanDatabase> places_;
  std::string label_;
  std::vector<LoopSearch::KeyScan> newest_, earlier_;
  bool on_new_ground_;
};

/// What such searches look in: `earlier` as it lies in `map`, which has key frames.
std::shared_ptr<const ScanDatabase> placesToLoopTo(const map::Map& map, const std::string& label,
                                                   const std::vector<LoopSearch::KeyScan>& earlier,
                                                   std::shared_ptr<const matching::ScanMatcher> matcher);

}  // namespace omnimapper::plugins
