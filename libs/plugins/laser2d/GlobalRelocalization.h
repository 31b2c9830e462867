#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// One relocalization of a session that nothing ties to the saved map, as a job: where the windows of LoopSearch are
/// too small for what is known of its place, the newest scans are sought in the whole map. The first answer only moves
/// the session there; the next one that agrees is a closure.
class GlobalRelocalization {
 public:
  /// `newest`: of the session, the newest last, clouds of `label`. `way`: [m] that the session has driven.
  GlobalRelocalization(const LoopClosureOptions& options, const mapper::PluginContext& context,
                       std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const ScanDatabase> places,
                       const std::string& label, std::vector<LoopSearch::KeyScan> newest, double travel);

  /// A hypothesis, or a place for the session; a decision with the numbers if anything was sought.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  bool isLost(const mapper::State& state, mapper::Decision& decision) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::shared_ptr<const ScanDatabase> places_;
  std::string label_;
  std::vector<LoopSearch::KeyScan> newest_;
  double travel_;  // [m]
};

}  // namespace omnimapper::plugins
