#pragma once

#include <omnimapper/graph/Graph.h>

namespace omnimapper::graph {

/// Moves one variable to the least cost of the factors that bind it, all others held: the cheap estimate of a variable
/// that was just added. A fixed variable, or one that nothing binds, stays. The cost never rises.
void solveOne(Graph& graph, base::VariableId id);

}  // namespace omnimapper::graph
