#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// A job that relocalizes a session which no measurement ties to the saved map yet. If the session's pose is less
/// certain than the windows of LoopSearch are large, or if the session has already travelled more than lost_travel, the
/// newest scans are searched for in the whole map. The first answer only moves the session to the place found; a later
/// answer that agrees with this place becomes a loop closure.
class GlobalRelocalization {
 public:
  /// `newest`: scans of the session, from clouds with the label `label`, the newest last. `travel`: distance travelled
  /// in the session [m].
  GlobalRelocalization(const LoopClosureOptions& options, const mapper::PluginContext& context,
                       std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const ScanDatabase> places,
                       const std::string& label, std::vector<LoopSearch::KeyScan> newest, double travel);

  /// Empty if the map need not be searched. Otherwise a decision with the numbers of the search and, if a place was
  /// found, a loop closure hypothesis or a new pose for the session.
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
