#pragma once

#include <string>

namespace omnimapper::sim {

/// Throws base::Error(out_of_range) unless low < high, naming both keys. The message begins with `place`, which is that
/// of SensorContext::place().
void requireBelow(const std::string& place, const std::string& low_key, double low, const std::string& high_key,
                  double high);

/// Throws base::Error(out_of_range): "<place><key> = <value>: <what>".
[[noreturn]] void refuseValue(const std::string& place, const std::string& key, double value, const std::string& what);

}  // namespace omnimapper::sim
