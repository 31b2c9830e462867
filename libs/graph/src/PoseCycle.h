#pragma once

#include <optional>

#include "Innovation.h"

namespace omnimapper::graph {

/// Whether two Between factors of the same kind close one cycle, pose i to j over `first`, j to l, l to k over
/// `second`, k to i: what `second` measures against what `first` and the graph say, where only the short ways i to k
/// and j to l are taken from the graph. So it holds however wrong the graph is about the way between the two ends. None
/// for factors of other kinds. Source: Mangelson et al., ICRA 2018, eq. 8.
std::optional<InnovationStatistics> poseCycle(const Graph& graph, const Marginals& marginals, base::FactorId first,
                                              base::FactorId second, double inflation);

}  // namespace omnimapper::graph
