#pragma once

#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/graph/Solver.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What became of forbidden loop closures: a clause on each.
struct ForbiddenLoops {
  std::vector<std::string> removed, kept;
};

/// Removes the loop closures that people forbade (map::Corrections) from a map that is continued, and if there were
/// any, solves its graph again. One without which the graph would not
/// determine a part of the map, or a direction of it, is kept: such a map could not be read again.
ForbiddenLoops removeForbidden(derived::SavedMap& saved, const graph::SolveOptions& options);

}  // namespace omnimapper::mapper
