#pragma once

#include <string>
#include <vector>

namespace omnimapper::base {

/// Keys whose values differ between two INIs, such as "[trigger] distance_m (0.2, was 0.5)", with "not set" for a
/// missing key: those of `now` in their order, then those that only `before` has. Left out are the sections
/// of sensors ([live], and those with a key `driver`) and sections with only a class, because they have no settings.
std::vector<std::string> iniDifferences(const std::string& now, const std::string& before);

}  // namespace omnimapper::base
