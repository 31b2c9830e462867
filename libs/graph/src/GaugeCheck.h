#pragma once

#include <optional>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A variable of a connected part of the graph that is not constrained (see solve()); none if there is no such part.
/// Factors of weight 0, and variables that no other factor binds, count as absent.
std::optional<base::VariableId> unconstrainedVariable(const Graph& graph);

/// Throws Error(internal), naming such a variable, if there is one.
void checkGauge(const Graph& graph);

}  // namespace omnimapper::graph
