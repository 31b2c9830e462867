#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// Joint covariance of variables of a graph that has grown since its marginals were computed; the blocks are in the
/// order of `ids`. New variables are treated as if they were estimated from their factors while all older variables are
/// held. Their covariance is the covariance that these factors give, plus the covariance that is propagated from the
/// older variables that these factors bind. What new factors say about older variables is ignored. Factors far along
/// the trajectory are ignored as well if nearer ones determine everything. So the covariance is never too small. The
/// cost depends on what was added near `ids`, not on the size of the graph. None if no factor determines some direction
/// of a new variable, or if one of `ids` is neither new nor in the marginals.
std::optional<Eigen::MatrixXd> jointCovariance(const Marginals& before, const Graph& grown,
                                               const std::vector<base::VariableId>& ids);

}  // namespace omnimapper::graph
