#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A factor, linearized at the graph's values.
struct Linearized {
  Eigen::VectorXd residual;                ///< whitened
  std::vector<Eigen::MatrixXd> jacobians;  ///< whitened derivatives by the tangent of each variable

  /// Linearizes a factor that need not be in the graph. Throws Error(internal) if its variables are not in the graph.
  Linearized(const Graph& graph, const FactorRecord& record);
  Linearized(const Graph& graph, base::FactorId factor) : Linearized(graph, graph.factor(factor)) {}
};

}  // namespace omnimapper::graph
