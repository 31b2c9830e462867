#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// A job that searches the whole earlier map for loops outside the windows of LoopSearch. It searches if the estimate
/// is less certain than those windows are large, or if the newest scan does not fit the map at the estimated pose. A
/// match within a window of LoopSearch is left to LoopSearch, which matches single passes of the robot and is more
/// exact; any other match becomes a hypothesis.
class GlobalLoopSearch {
 public:
  /// `newest`: the scans along the last metres travelled, the newest last. `earlier`: all scans that are old enough for
  /// a loop. `places`: the result of placesToLoopTo() for these earlier scans, or for a somewhat smaller, older set of
  /// them. All scans are from clouds with the label `label`. `on_new_ground`: if true, searches even where, by the
  /// estimate, certainly nothing was seen before.
  GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                   std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const ScanDatabase> places,
                   std::string label, std::vector<LoopSearch::KeyScan> newest, std::vector<LoopSearch::KeyScan> earlier,
                   bool on_new_ground);

  /// Empty if there is no reason to search; else a decision, with a hypothesis if exactly one place fits.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// How reliable the estimated pose of the robot is.
  struct Estimate {
    double uncertainty;  // [m] three standard deviations
    bool is_lost;  // a global search is needed: the pose is too uncertain, or the newest scan does not fit the map
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

/// The database that GlobalLoopSearch searches: the scans of `earlier` at their poses in `map`, which has key frames.
std::shared_ptr<const ScanDatabase> placesToLoopTo(const map::Map& map, const std::string& label,
                                                   const std::vector<LoopSearch::KeyScan>& earlier,
                                                   std::shared_ptr<const matching::ScanMatcher> matcher);

}  // namespace omnimapper::plugins
