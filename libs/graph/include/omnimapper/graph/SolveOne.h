#pragma once

#include <omnimapper/graph/Graph.h>

namespace omnimapper::graph {

/// Minimizes the cost of the factors that bind one variable by moving this variable alone: a cheap estimate for a
/// variable that was just added. A fixed variable, or one that no factor binds, keeps its value. The cost never rises.
void solveOne(Graph& graph, base::VariableId id);

}  // namespace omnimapper::graph
