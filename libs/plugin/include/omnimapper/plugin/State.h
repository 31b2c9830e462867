#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Uncertainty.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Read-only map, graph and their uncertainty. Valid only during the call that it is passed to.
struct State {
  const map::Map& map;
  const graph::Graph& graph;
  const Uncertainty& uncertainty;

  /// Covariance of the motion between two key frames, as Uncertainty::between().
  std::optional<Eigen::Matrix<double, 6, 6>> covarianceBetween(base::KeyFrameId from, base::KeyFrameId to) const {
    return uncertainty.between(map, graph, from, to);
  }
  /// Joint covariance of variables, as Uncertainty::joint().
  std::optional<Eigen::MatrixXd> jointCovariance(const std::vector<base::VariableId>& ids) const {
    return uncertainty.joint(graph, ids);
  }
  /// Whether the relative pose of two sessions is known: they are the same session, or both are aligned with the map.
  bool areAligned(std::uint16_t session, std::uint16_t other) const;
  /// Every factor on the landmark's variables, in the order of ids.
  std::vector<base::FactorId> factorsOf(base::LandmarkId id) const;
  /// Active landmarks of the plugin with this INI section, which new observations may be associated with.
  std::vector<base::LandmarkId> candidates(const std::string& owner) const;
};

/// A separate copy of the state for jobs, which does not change any more. It is cheap to make, because unchanged data
/// are shared.
struct Snapshot {
  map::Map map;
  graph::Graph graph;
  Uncertainty uncertainty;

  State state() const { return {map, graph, uncertainty}; }
};

}  // namespace omnimapper::mapper
