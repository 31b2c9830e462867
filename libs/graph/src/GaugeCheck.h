#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Throws Error(internal) if a connected part of the graph is not constrained (see solve()). Factors of weight 0, and
/// variables that no other factor binds, count as absent.
void checkGauge(const Graph& graph);

}  // namespace omnimapper::graph
