#pragma once

#include <string>
#include <vector>

namespace omnimapper::program {

/// The paths of INI files, where a name without a folder that is not in the current one is that of an INI that came
/// with the program: `share/omnimapper/ini` and `share/omnimapper/rawlogs` beside `bin`, or `ini` and `rawlogs` of the
/// checkout that it was built in.
std::vector<std::string> findInis(const std::vector<std::string>& names);

}  // namespace omnimapper::program
