#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What has to change so that the plugins of a run become those of another INI.
struct PluginDifference {
  PluginChange change;
  std::vector<std::string> added, removed, renewed;  ///< sections; `renewed` get other settings
  std::vector<std::string> unused;  ///< "[trigger] distance_m (0.2, was 0.5)": differences that need a new run

  bool isNone() const { return added.empty() && removed.empty() && renewed.empty(); }
  /// "added walls; removed planes; gave points other settings"; empty if isNone().
  std::string sentence() const;
};

/// Makes the plugins that `now` adds to those of `before`, or gives other settings. `more_outputs`: sections of outputs
/// beside those of the INIs. Throws base::Error as makePlugins() and loadPluginLibraries().
PluginDifference differenceOf(const base::Config& before, const base::Config& now,
                              const std::vector<std::string>& more_outputs, const PluginContext& context);

}  // namespace omnimapper::mapper
