#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A factor to first order at the graph's values.
struct Linearised {
  Eigen::VectorXd residual;                ///< whitened
  std::vector<Eigen::MatrixXd> jacobians;  ///< whitened, by the tangent of each of its variables

  Linearised(const Graph& graph, base::FactorId factor);
};

}  // namespace omnimapper::graph
