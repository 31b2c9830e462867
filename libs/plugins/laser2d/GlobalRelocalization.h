#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// A job that relocalizes a session which no measurement ties to the saved map yet. If its pose is less certain than
/// the windows of LoopSearch are large, or nothing was found there for long, the newest scans are searched for in the
/// whole map. The first answer only moves the session there; the next answer that agrees becomes a loop closure.
class GlobalRelocalization {
 public:
  /// `newest`: scans of the session in clouds of `label`, the newest last. `travel`: [m] travelled in the session.
  GlobalRelocalization(const LoopClosureOptions& options, const mapper::PluginContext& context,
                       std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const ScanDatabase> places,
                       const std::string& label, std::vector<LoopSearch::KeyScan> newest, double travel);

  /// A loop closure hypothesis or a new pose for the session; a decision with the numbers if the map was searched.
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
