#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Evidence on a finished map from signs of a plugin's section with numbers of three or more digits: whether numbers
/// that were read again after `recent_travel` [m] are at the same place, and how much of the distance travelled lies
/// between two visits of the same sign. Empty if none was read again.
std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section, double recent_travel);

}  // namespace omnimapper::plugins
