#pragma once

#include <iosfwd>

#include "omnimapper/graph/FactorRegistry.h"
#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A graph as bytes, versioned, little-endian. What is read back is the same graph: ids (those that were removed are
/// not given again), values, noise, losses, weights and tags to the bit; written again, it gives the same bytes.
void writeGraph(const Graph& graph, std::ostream& out);

/// Reads what writeGraph() wrote, and leaves the stream behind it.
/// Throws Error(damaged_input) on data that is cut short, is no graph or contradicts itself, Error(unreadable_input) on
/// a version of the future, Error(unregistered_class) on a kind that the registry does not know.
Graph readGraph(std::istream& in, const FactorRegistry& registry);

}  // namespace omnimapper::graph
