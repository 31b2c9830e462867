#pragma once

#include <Eigen/Core>
#include <optional>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// The distribution of a false hypothesis: it may take any two places of the map for the same one. A true one is
/// distinguished from it because it agrees with the prediction of the graph.
class OutlierModel {
 public:
  /// The map is the box around the poses of the graph, at least 1 m wide.
  explicit OutlierModel(const Graph& graph);
  /// Logarithm of the factor's outlierVolume() in whitened units; none if it has none.
  std::optional<double> logOf(const FactorRecord& record) const;

 private:
  Eigen::Vector3d size_;
};

}  // namespace omnimapper::graph
