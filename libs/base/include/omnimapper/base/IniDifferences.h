#pragma once

#include <string>
#include <vector>

namespace omnimapper::base {

/// Keys whose values differ between two INIs, such as "[trigger] distance_m (0.2, was 0.5)"; "not set" stands for the
/// value of a missing key. First come the keys of `now` in their order, then the keys that only `before` has. Sections
/// of sensors are left out ([live], and those with a key `driver`), and so is a section that has only a `class` and is
/// missing in the other INI, because it has no settings. Keys that were
/// renamed are compared, and given, by their present names.
std::vector<std::string> iniDifferences(const std::string& now, const std::string& before);

}  // namespace omnimapper::base
