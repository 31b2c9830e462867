#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Throws Error(internal) if a connected part of the graph hangs free (see solve()). Factors of weight 0 count as
/// absent, and so do variables that no other factor binds.
void checkGauge(const Graph& graph);

}  // namespace omnimapper::graph
