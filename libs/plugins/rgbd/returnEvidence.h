#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/Verdict.h>

#include <utility>
#include <vector>

namespace omnimapper::plugins {

/// Stamps of a view and of a later image that shows the view again.
using Loop = std::pair<base::Stamp, base::Stamp>;

/// How often a camera returned to an old view, and whether enough of the time from `begin` to `end` lies between two
/// views of one place, because drift shows only there.
std::vector<mapper::Evidence> returnEvidence(std::vector<Loop> loops, base::Stamp begin, base::Stamp end);

}  // namespace omnimapper::plugins
