#pragma once

#include <cstddef>
#include <vector>

namespace omnimapper::perception::objects {

/// A border between two nodes of a graph.
struct SignedLink {
  int a = 0, b = 0;
  float weight = 0;  ///< evidence that the two nodes belong together; negative: that they do not
  float length = 0;  ///< of the border, in the same unit as `kBriefBorder`
};

/// A border of this length has half of the say about the order in which groups are joined that a very long one has.
constexpr float kBriefBorder = 4;

/// Partitions the nodes of a graph: as long as any two groups of nodes are linked by a positive sum of weights, two of
/// them are joined, those with the most weight for each unit of their border first. Short borders wait, because their
/// mean is not reliable: the sum of weights is divided by the length plus kBriefBorder. Nearly minimizes the weights
/// that are cut (Keuper et al., Efficient decomposition of image and mesh graphs by lifted multicuts, ICCV 2015: greedy
/// additive edge contraction, with another order). Equal links go by the numbers of the nodes. There is at most one
/// link between two nodes, and none from a node to itself.
/// Returns a number of each node's group; the groups are numbered from 0 in the order of their first nodes.
std::vector<int> contract(std::size_t nodes, const std::vector<SignedLink>& links);

}  // namespace omnimapper::perception::objects
