#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/Verdict.h>

#include <utility>
#include <vector>

namespace omnimapper::plugins {

/// A view, and when it came back.
using Loop = std::pair<base::Stamp, base::Stamp>;

/// How often a camera came back to a view of long before, and whether enough of the time from `begin` to `end` lies
/// between two views of one place: only there a map shows what it drifted by.
std::vector<mapper::Evidence> returnEvidence(std::vector<Loop> loops, base::Stamp begin, base::Stamp end);

}  // namespace omnimapper::plugins
