#pragma once

#include <optional>

#include "Innovation.h"

namespace omnimapper::graph {

/// Tests whether two Between factors of the same kind close a cycle: pose i to j by `first`, j to l, l to k by
/// `second`, k to i. The result is the innovation of `second`, given `first` and the graph, of which only the short
/// paths i to k and j to l are used. So it is valid however wrong the graph is about the path between the two ends.
/// None for factors of other kinds. Source: Mangelson et al., ICRA 2018, eq. 8.
std::optional<InnovationStatistics> poseCycle(const Graph& graph, const Marginals& marginals, base::FactorId first,
                                              base::FactorId second, double inflation);

}  // namespace omnimapper::graph
