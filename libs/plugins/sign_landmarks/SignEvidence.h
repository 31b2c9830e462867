#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// What numbers of three digits and more say of a finished map, by the signs of a plugin's section: whether those that
/// were read again after `recent_travel` [m] stand at one place, and how much of the distance travelled lies between
/// two visits of one. Nothing if none was read again.
std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section, double recent_travel);

}  // namespace omnimapper::plugins
