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
  bool is_reordered = false;                         ///< the lists have another order
  std::vector<std::string> unused;  ///< "[trigger] distance_m (0.2, was 0.5)": differences that need a new run

  bool isNone() const { return added.empty() && removed.empty() && renewed.empty() && !is_reordered; }
  /// "added walls; removed planes; gave other settings to points"; empty if isNone().
  std::string sentence() const;
};

/// Makes the plugins that `now` adds to those of `before`, or gives other settings; they are made with the text of
/// `now` in their context. `kept`: sections of outputs that stay as they are, such as a window that a user looks at.
/// `more_outputs`: sections of outputs beside those of the INIs. Throws base::Error as makePlugins() and
/// loadPluginLibraries().
PluginDifference differenceOf(const base::Config& before, const base::Config& now,
                              const std::vector<std::string>& more_outputs, PluginContext context,
                              const std::vector<std::string>& kept = {});

}  // namespace omnimapper::mapper
