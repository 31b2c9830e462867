#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// Plugins that an INI lists, by the names of their sections.
struct PluginLists {
  std::vector<std::string> pose, extractors, measurement;
  bool odometry_is_fallback = false;  ///< [odometry] fallback of the INI
};

/// One of the INIs that come with the project.
struct FittingIni {
  std::string file;  ///< "ini/laser2d.ini"
  std::string what;  ///< what it maps
  PluginLists plugins;
  bool needs_settings = false;  ///< whether it maps them only with the settings that `what` names
  bool is_a_guess = false;      ///< whether it is not known that the sensors saw what it maps
};

/// The INIs that can map what the log's sensors saw, first the one that uses most of the sensors; empty if none can.
std::vector<FittingIni> fittingInis(const LogFacts& facts);

}  // namespace omnimapper::check
