#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A factor, linearised at the graph's values.
struct Linearised {
  Eigen::VectorXd residual;                ///< whitened
  std::vector<Eigen::MatrixXd> jacobians;  ///< whitened, by the tangent of each of its variables

  /// Linearises a factor that need not be in the graph. Its variables must be, else Error(internal) is thrown.
  Linearised(const Graph& graph, const FactorRecord& record);
  Linearised(const Graph& graph, base::FactorId factor) : Linearised(graph, graph.factor(factor)) {}
};

}  // namespace omnimapper::graph
