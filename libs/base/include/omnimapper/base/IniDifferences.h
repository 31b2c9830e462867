#pragma once

#include <string>
#include <vector>

namespace omnimapper::base {

/// Keys whose values differ between two INIs, in the order of the first and then of the second: "[trigger] distance_m
/// (0.2, was 0.5)", with "not set" for a missing key. Sections with a key `driver`, which are for another program,
/// sections with only a class, which have no settings, and [live] are left out.
std::vector<std::string> iniDifferences(const std::string& now, const std::string& before);

}  // namespace omnimapper::base
