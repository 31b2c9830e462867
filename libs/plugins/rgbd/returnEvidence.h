#pragma once

#include <omnimapper/plugin/Verdict.h>

#include <cstddef>
#include <vector>

namespace omnimapper::plugins {

/// How often a camera came back to a view of long before, and whether enough of the time lies between two views of one
/// place: only there a map shows what it drifted by. `between`: that time [s], of `all` [s].
std::vector<mapper::Evidence> returnEvidence(std::size_t returns, double between, double all);

}  // namespace omnimapper::plugins
