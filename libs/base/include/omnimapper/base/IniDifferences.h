#pragma once

#include <string>
#include <vector>

namespace omnimapper::base {

/// Keys whose values differ between two INIs, in the order of the first and then of the second:
/// "[trigger] distance_m (0.2, was 0.5)", with "not set" for a key that is missing. Sections with a key `driver` are
/// another program's and sections with nothing but a class have no settings: both are left out, as is [live].
std::vector<std::string> iniDifferences(const std::string& now, const std::string& before);

}  // namespace omnimapper::base
