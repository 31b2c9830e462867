#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Whether a variable of the factor is free and bound by no acting factor, so that there is nothing to test the factor
/// against: the place of another session's map, or a landmark that is seen for the first time.
bool bindsUnconstrained(const Graph& graph, base::FactorId factor);

/// Lets such a factor act, which distorts nothing, and sets the variables that it alone binds to the values that it
/// measures.
void initializeUnconstrained(Graph& graph, base::FactorId factor);

}  // namespace omnimapper::graph
