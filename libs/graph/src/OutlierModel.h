#pragma once

#include <Eigen/Core>
#include <optional>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Where a false hypothesis may lie: two places of the map, any two, are taken for one. A true one is told from it by
/// being where the graph expects it.
class OutlierModel {
 public:
  /// The map is the box around the poses of the graph, at least 1 m wide.
  explicit OutlierModel(const Graph& graph);
  /// Logarithm of the volume that the measurement of a Between factor may lie in, or that between points that are said
  /// to be one, in whitened units; times the prior odds of a factor that has any. None for other kinds: what could be
  /// false about them is not known here.
  std::optional<double> logOf(const FactorRecord& record) const;

 private:
  Eigen::Vector3d size_;
};

}  // namespace omnimapper::graph
