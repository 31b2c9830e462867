#pragma once

#include <string>
#include <vector>

namespace omnimapper::source {

/// Unix times [s] that files are named by, in seconds with or without decimals, or in nanoseconds. Empty unless all
/// names are such times, each later than the one before.
std::vector<double> timesOfNames(const std::vector<std::string>& files);

}  // namespace omnimapper::source
