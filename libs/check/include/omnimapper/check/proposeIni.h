#pragma once

#include <omnimapper/check/LogFacts.h>
#include <omnimapper/check/fittingInis.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// A key of an INI that should be set, and why.
struct Setting {
  std::string section, key, value, reason;
};

/// Whether the log has data for at least one of the measurement plugins in `plugins`, which an INI names.
bool canMeasure(const LogFacts& facts, const PluginLists& plugins);

/// Settings to change for this log in an INI that names these plugins, such as the first of fittingInis().
std::vector<Setting> proposeIni(const LogFacts& facts, const PluginLists& plugins);

/// The settings as an INI file, to be passed after the INI that they change; empty if there are none.
std::string toIni(const std::vector<Setting>& settings);

}  // namespace omnimapper::check
