#pragma once

#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/Verdict.h>

#include <functional>
#include <string>
#include <vector>

#include "RunState.h"

namespace omnimapper::mapper {

/// Collects the evidence for and against a map: of its plugins, of its sessions, of its tilt, and of the log.
class MapEvidence {
 public:
  /// The caller owns `plugins` and `state`.
  MapEvidence(Motion motion, const PluginSet& plugins, RunState& state)
      : motion_(motion), plugins_(plugins), state_(state) {}

  /// Evidence on the observations, which judge() adds to that of the map.
  void setOfInput(std::vector<Evidence> evidence) { of_input_ = std::move(evidence); }
  /// Keeps the evidence of the plugins that are about to be removed.
  void keep(const std::function<bool(const std::string& section)>& is_removed);
  /// Makes the verdict of the run from the evidence as it is now.
  void judge();

 private:
  std::vector<Evidence> ofPlugins(const std::function<bool(const std::string& section)>& is_asked);
  std::vector<Evidence> ofSessions() const;

  Motion motion_;
  const PluginSet& plugins_;
  RunState& state_;
  std::vector<Evidence> of_input_, of_removed_;
};

}  // namespace omnimapper::mapper
