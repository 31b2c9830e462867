#pragma once

#include <string>
#include <vector>

namespace omnimapper::program {

/// The paths of INI files. A name that is not found in the current folder, and has no folder or the folder `ini` or
/// `rawlogs`, is looked up among the INIs that come with the program: in `share/omnimapper/ini` and
/// `share/omnimapper/rawlogs` beside `bin`, or in `ini` and `rawlogs` of the checkout in which the program was built.
/// If both folders have an INI of that name, the one in `first_folder` is used. Throws Error(unreadable_input), with
/// the known names, if a name without a folder is found nowhere.
std::vector<std::string> findInis(const std::vector<std::string>& names, const std::string& first_folder = "ini");

}  // namespace omnimapper::program
