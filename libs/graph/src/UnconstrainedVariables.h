#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// True if a variable of the factor is free and held by nothing that acts, so that there is nothing to test it against:
/// the place of another session's map, a landmark seen for the first time.
bool bindsUnconstrained(const Graph& graph, base::FactorId factor);

/// Lets such a factor act, which bends nothing, and puts the variables it alone holds where it says.
void initializeUnconstrained(Graph& graph, base::FactorId factor);

}  // namespace omnimapper::graph
