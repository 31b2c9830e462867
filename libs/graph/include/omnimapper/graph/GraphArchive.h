#pragma once

#include <iosfwd>

#include "omnimapper/graph/FactorRegistry.h"
#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Writes a graph as versioned, little-endian bytes. A graph that is read back has the same ids, values, noise, losses,
/// weights and tags, bit by bit; ids of removed records are not used again. Writing that graph again gives the same
/// bytes.
void writeGraph(const Graph& graph, std::ostream& out);

/// Reads what writeGraph() wrote, and leaves the stream at the first byte after that. Throws Error(damaged_input) if
/// the data is cut short, is not a graph or contradicts itself, Error(unreadable_input) if its version is later than
/// this program's, and Error(unregistered_class) for a kind that the registry does not know.
Graph readGraph(std::istream& in, const FactorRegistry& registry);

}  // namespace omnimapper::graph
