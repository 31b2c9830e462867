#pragma once

#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// What is different in a graph since a solver took it last.
struct GraphChanges {
  std::vector<base::FactorId> added;
  std::vector<base::FactorId> removed;
  std::vector<base::FactorId> changed;  ///< of another weight, loss, noise or binding, or of a variable that was fixed,
                                        ///< freed, or moved while it is fixed
  std::vector<base::VariableId> moved;  ///< free variables that were given another value

  bool empty() const { return added.empty() && removed.empty() && changed.empty() && moved.empty(); }
};

/// How `after` differs from `before`, of which it is an edited copy, or the other way round. Lists are in the order of
/// ids. The time grows with what was edited, not with the graph.
GraphChanges changesBetween(const Graph& before, const Graph& after);

}  // namespace omnimapper::graph
