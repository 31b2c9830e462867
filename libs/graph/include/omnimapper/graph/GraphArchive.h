#pragma once

#include <iosfwd>

#include "omnimapper/graph/FactorRegistry.h"
#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Writes a graph as versioned, little-endian bytes. Reading restores the same ids, values, noise, losses, weights and
/// tags bit by bit, and ids of removed records are not used again; writing it again gives the same bytes.
void writeGraph(const Graph& graph, std::ostream& out);

/// Reads what writeGraph() wrote, and leaves the stream at the first byte after it.
/// Throws Error(damaged_input) on data that is cut short, is not a graph or contradicts itself, Error(unreadable_input)
/// on a later version, Error(unregistered_class) on a kind that the registry does not know.
Graph readGraph(std::istream& in, const FactorRegistry& registry);

}  // namespace omnimapper::graph
