#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/map/Map.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// Covariances for gates. The matrix of the graph as it was at construction is decomposed once, at the first query, in
/// the thread of that query, unless a decomposition was given. For key frames that were added later, the covariance is
/// propagated by the factors along the trajectory. Copies share the decomposition. Results do not depend on earlier
/// queries.
class Uncertainty {
 public:
  /// Without a graph: every result is none.
  Uncertainty() = default;
  /// Takes a copy of `graph`, which is cheap.
  explicit Uncertainty(const graph::Graph& graph);
  /// The same with a matrix of `graph` that is decomposed already.
  Uncertainty(const graph::Graph& graph, graph::Marginals marginals);

  /// Covariance of inverse(map_from_base of `from`) * map_from_base of `to`: tangent at `to`, x y z [m], rotation
  /// vector [rad]; zeros outside x, y, yaw in a planar map. None while a direction of some variable is undetermined, or
  /// if the factors along the trajectory do not reach a key frame that was added later. `map` and `graph` are the
  /// current ones.
  std::optional<Eigen::Matrix<double, 6, 6>> between(const map::Map& map, const graph::Graph& graph,
                                                     base::KeyFrameId from, base::KeyFrameId to) const;

  /// Joint covariance of variables of `graph` in their tangents, blocks in the order of `ids`. Variables that were
  /// added after construction are extrapolated by graph::jointCovariance(). None as in between().
  std::optional<Eigen::MatrixXd> joint(const graph::Graph& graph, const std::vector<base::VariableId>& ids) const;

 private:
  struct Solved;
  std::shared_ptr<const Solved> solved_;
};

}  // namespace omnimapper::mapper
