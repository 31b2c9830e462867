#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// Joint covariance of variables of a graph that has grown since its marginals were made, blocks in the order of `ids`.
/// New variables are treated as estimated from their factors with all older variables held; their covariance is that of
/// these factors plus the propagated covariance of the older variables they are attached to. The information of new
/// factors about older variables is ignored, and so is that of factors far along the trajectory if nearer ones
/// determine everything: the covariance is never too small. The cost depends on what was added near `ids`, not on the
/// size of the graph. None if no factor determines some direction of a new variable, or if one of `ids` is neither new
/// nor in the marginals.
std::optional<Eigen::MatrixXd> jointCovariance(const Marginals& before, const Graph& grown,
                                               const std::vector<base::VariableId>& ids);

}  // namespace omnimapper::graph
