#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// Sections of plugins that an INI names.
struct PluginLists {
  std::vector<std::string> pose, extractors, measurement;
  bool odometry_is_fallback = false;  ///< [odometry] fallback
};

/// One of the INIs that come with the project.
struct FittingIni {
  std::string file;  ///< "ini/laser2d.ini"
  std::string what;  ///< that it maps
  PluginLists plugins;
  bool needs_settings = false;  ///< those that `what` names
  bool is_a_guess = false;      ///< whether the sensors saw what it maps nobody knows
};

/// The INIs that can map what the log's sensors saw, that which uses most of them first; none if nothing can.
std::vector<FittingIni> fittingInis(const LogFacts& facts);

}  // namespace omnimapper::check
