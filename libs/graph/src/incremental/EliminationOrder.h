#pragma once

#include <vector>

namespace omnimapper::graph {

/// Unknowns that are eliminated together: each of `frontals` shares factors, or fill, with all that come after it, and
/// with all of `separator`. Numbers are those of the caller.
struct Supernode {
  std::vector<int> frontals;
  std::vector<int> separator;  ///< in the order in which they are eliminated
  int parent = -1;             ///< the supernode that eliminates the first of the separator; -1: there is none
};

/// In which order to eliminate `count` nodes, given the sets of nodes that are bound to each other, so that the factor
/// stays sparse (constrained approximate minimum degree, CHOLMOD), with the nodes of `last` after all others. Returns
/// supernodes, each before its parent.
std::vector<Supernode> orderElimination(int count, const std::vector<std::vector<int>>& sets,
                                        const std::vector<bool>& last);

}  // namespace omnimapper::graph
