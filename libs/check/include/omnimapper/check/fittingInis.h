#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// Plugins that an INI lists, by the names of their sections.
struct PluginLists {
  std::vector<std::string> pose, extractors, measurement;
  bool odometry_is_fallback = false;      ///< value of `[odometry] fallback` in the INI
  std::vector<std::string> sensors = {};  ///< sections of `[mapper] sensors`

  /// Throws base::Error as ConfigSection::read().
  static PluginLists read(const base::Config& config);
};

/// One of the INIs that come with the project.
struct FittingIni {
  std::string file;  ///< "ini/laser2d.ini"
  std::string what;  ///< what the INI maps
  PluginLists plugins;
  bool needs_settings = false;  ///< true if the INI maps this only with the settings that `what` names
  bool is_a_guess = false;      ///< true if the log does not show whether the sensors saw what the INI maps
};

/// The INIs that can map what the log's sensors saw, as their headers say; the INI that uses most of the sensors comes
/// first. Empty if there is none.
std::vector<FittingIni> fittingInis(const LogFacts& facts);

}  // namespace omnimapper::check
