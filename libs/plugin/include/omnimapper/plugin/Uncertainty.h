#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// How well things are known, for gates. The graph as it was when this was made is factored once, when first asked, by
/// whichever thread asks; key frames that came later are reached by the factors along the trajectory. Copies share the
/// factored graph. What it answers depends on graph and map alone, not on who asked before.
class Uncertainty {
 public:
  /// Of no graph: every answer is none.
  Uncertainty() = default;
  /// Takes a copy of `graph`, which is cheap.
  explicit Uncertainty(const graph::Graph& graph);

  /// Covariance of inverse(map_from_base of `from`) * map_from_base of `to`: tangent at `to`, x y z [m], rotation
  /// vector [rad]; zeros outside x, y, yaw in a planar map. None while a direction of some variable is determined by
  /// nothing, or where the trajectory does not lead to the later of the two. `map` and `graph`: as they are now.
  std::optional<Eigen::Matrix<double, 6, 6>> between(const map::Map& map, const graph::Graph& graph,
                                                     base::KeyFrameId from, base::KeyFrameId to) const;

  /// Joint covariance of variables of `graph` in their tangents, blocks in the order of `ids`; those that came since
  /// the graph was factored as graph::jointCovariance() has them. None as above.
  std::optional<Eigen::MatrixXd> joint(const graph::Graph& graph, const std::vector<base::VariableId>& ids) const;

 private:
  struct Solved;
  std::shared_ptr<const Solved> solved_;
};

}  // namespace omnimapper::mapper
