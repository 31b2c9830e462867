#pragma once

#include <vector>

#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Lets the minimizer solve the graph. Factors of `fresh` hypotheses that act and state that two points are the same,
/// although they are more than a hundred standard deviations apart, start with a small weight, which grows from solve
/// to solve. At full weight, the first step would tear a point away from its measured directions, whose loss is robust,
/// and the solution would stay there.
void solveEased(Graph& graph, const std::vector<base::FactorId>& fresh, const SolveOptions& options,
                Minimizer& minimizer);

}  // namespace omnimapper::graph
