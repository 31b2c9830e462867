#pragma once

#include <string>
#include <vector>

namespace omnimapper::source {

/// [s] The Unix times that files are called by, in seconds, with decimals or without, or in nanoseconds; empty unless
/// all names are such times, each later than the one before.
std::vector<double> timesOfNames(const std::vector<std::string>& files);

}  // namespace omnimapper::source
