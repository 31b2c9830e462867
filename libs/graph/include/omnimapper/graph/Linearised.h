#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A factor to first order at the graph's values.
struct Linearised {
  Eigen::VectorXd residual;                ///< whitened
  std::vector<Eigen::MatrixXd> jacobians;  ///< whitened, by the tangent of each of its variables

  /// Of a factor that is not in the graph, but binds variables of it. Throws Error(internal) if it does not.
  Linearised(const Graph& graph, const FactorRecord& record);
  Linearised(const Graph& graph, base::FactorId factor) : Linearised(graph, graph.factor(factor)) {}
};

}  // namespace omnimapper::graph
