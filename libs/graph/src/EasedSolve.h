#pragma once

#include <vector>

#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Solves. Points that `fresh` hypotheses which act take for one, and that are hundreds of standard deviations apart,
/// draw on each other gently at first: at full weight the first step would tear a point from the directions that it was
/// seen in, whose loss is robust, and the solution stay there.
void solveEased(Graph& graph, const std::vector<base::FactorId>& fresh, const SolveOptions& options);

}  // namespace omnimapper::graph
