#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// Joint covariance of variables of a graph that has grown since its marginals were made, blocks in the order of `ids`.
/// Variables that came since are taken as estimated from their factors with all older ones held: their covariance is
/// that of these factors, with the covariance of what they hang on carried along. What new factors tell of older
/// variables is left out, and so is what they tell far along the trajectory where nearer ones determine all: it is
/// never too small. Costs what has come since near `ids`, whatever the size of the graph. None if a direction of a new
/// variable is determined by nothing, or if one of `ids` is neither there nor in the marginals.
std::optional<Eigen::MatrixXd> jointCovariance(const Marginals& before, const Graph& grown,
                                               const std::vector<base::VariableId>& ids);

}  // namespace omnimapper::graph
