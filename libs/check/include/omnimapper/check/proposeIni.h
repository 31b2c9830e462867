#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// A key of an INI to be set.
struct Setting {
  std::string section, key, value, reason;
};

/// What to change in the first of fittingInis() for this log. `pose_plugins` is the list it has now.
std::vector<Setting> proposeIni(const LogFacts& facts, const std::vector<std::string>& pose_plugins);

/// As an INI file, which goes over it; empty if there is nothing to set.
std::string toIni(const std::vector<Setting>& settings);

}  // namespace omnimapper::check
