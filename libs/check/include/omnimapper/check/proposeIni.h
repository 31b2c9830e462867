#pragma once

#include <omnimapper/check/LogFacts.h>
#include <omnimapper/check/fittingInis.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// A key of an INI to be set.
struct Setting {
  std::string section, key, value, reason;
};

/// Whether an INI that names these plugins has anything left to measure with in this log.
bool canMeasure(const LogFacts& facts, const PluginLists& plugins);

/// What to change for this log in an INI that names these plugins, such as the first of fittingInis().
std::vector<Setting> proposeIni(const LogFacts& facts, const PluginLists& plugins);

/// As an INI file, which goes over it; empty if there is nothing to set.
std::string toIni(const std::vector<Setting>& settings);

}  // namespace omnimapper::check
