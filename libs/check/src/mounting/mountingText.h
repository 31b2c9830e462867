#pragma once

#include <string>
#include <vector>

#include "SensorMounting.h"

namespace omnimapper::check {

/// What was measured and how well, what was not and why, and what has two causes. `left_out` says what is not in the
/// INI, `contradictions` what the log still contradicts.
std::string mountingText(const std::string& title, const SensorMounting& mounting,
                         const std::vector<std::string>& left_out, const std::vector<std::string>& contradictions);

}  // namespace omnimapper::check
