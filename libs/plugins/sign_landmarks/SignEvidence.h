#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Evidence on a finished map from those signs of the INI section `section` that have a number of three or more digits:
/// whether the numbers that were read again after `recent_travel` [m] are at the same place, and how much of the
/// distance travelled lies between two visits of the same sign. Empty if no number was read again.
std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section, double recent_travel);

}  // namespace omnimapper::plugins
