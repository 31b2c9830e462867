#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// What numbers of three digits and more say of a finished map, by the signs of a plugin's section: whether those that
/// were met again stand at one place, and how much of the time lies between two visits of one. Nothing if none was met
/// again.
std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section);

}  // namespace omnimapper::plugins
