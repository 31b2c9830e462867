#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Uncertainty.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Map, graph and what is known of their accuracy, const. Valid during the call it is given to.
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
  /// Whether it is known how two sessions lie to each other: they are one, or both are joined to the map.
  bool areJoined(std::uint16_t session, std::uint16_t other) const;
  /// Every factor that speaks of the landmark, in the order of ids.
  std::vector<base::FactorId> factorsOf(base::LandmarkId id) const;
  /// Active landmarks of a plugin, by its INI section: what a new observation may be associated with.
  std::vector<base::LandmarkId> candidates(const std::string& owner) const;
};

/// A state of its own that nothing changes any more, for jobs. Making it costs little: it shares what has not changed.
struct Snapshot {
  map::Map map;
  graph::Graph graph;
  Uncertainty uncertainty;

  State state() const { return {map, graph, uncertainty}; }
};

}  // namespace omnimapper::mapper
