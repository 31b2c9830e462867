#pragma once

#include <string>
#include <vector>

namespace omnimapper::program {

/// The paths of INI files, where a name without a folder, or in `ini` or `rawlogs`, that is not in the current one is
/// that of an INI that came with the program: `share/omnimapper/ini` and `share/omnimapper/rawlogs` beside `bin`, or
/// `ini` and `rawlogs` of the checkout that it was built in. Throws Error(unreadable_input), with the names that there
/// are, for a name without a folder that is neither here nor came with it. A name that both folders have is that of
/// `first_folder`.
std::vector<std::string> findInis(const std::vector<std::string>& names, const std::string& first_folder = "ini");

}  // namespace omnimapper::program
