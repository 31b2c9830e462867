#include "PoseEdges.h"

#include <omnimapper/geometry/Covariance.h>

#include <map>

#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/PointFactor.h"
#include "omnimapper/graph/Prior.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

using geometry::Matrix6d;
using geometry::Se3;

Se3 inSpace(const geometry::Se2& pose) {
  return geometry::lift(pose);
}
Se3 inSpace(const Se3& pose) {
  return pose;
}

Matrix6d informationInSpace(const FactorRecord& record) {
  const Eigen::MatrixXd information = record.weight * record.noise.information();
  if (information.rows() == 6) return information;
  Matrix6d lifted = geometry::embedPlanar(information);
  lifted(2, 2) = 0.5 * (information(0, 0) + information(1, 1));
  lifted(3, 3) = lifted(4, 4) = information(2, 2);
  return lifted;
}

template <class BetweenFactor>
bool addBetween(const FactorRecord& record, PoseEdges& edges) {
  const auto* factor = dynamic_cast<const BetweenFactor*>(record.factor.get());
  if (!factor) return false;
  edges.edges.push_back({edges.index.at(record.variables[0]), edges.index.at(record.variables[1]),
                         inSpace(factor->measured()), informationInSpace(record)});
  return true;
}

template <class PriorFactor>
bool addPrior(const FactorRecord& record, PoseEdges& edges) {
  const auto* factor = dynamic_cast<const PriorFactor*>(record.factor.get());
  if (!factor) return false;
  edges.priors.push_back(
      {edges.index.at(record.variables[0]), inSpace(factor->measured()), informationInSpace(record)});
  return true;
}

/// The position of a point in the map by one point factor: 2 or 3 coordinates; empty for other kinds of factors.
Eigen::VectorXd seenInMap(const FactorRecord& record, const PoseEdges& edges) {
  if (const auto* factor = dynamic_cast<const PointFactor2*>(record.factor.get()))
    return geometry::project(edges.poses[edges.index.at(record.variables[0])].map_from_pose) * factor->measured();
  if (const auto* factor = dynamic_cast<const PointFactor3*>(record.factor.get()))
    return edges.poses[edges.index.at(record.variables[0])].map_from_pose * factor->measured();
  return {};
}

}  // namespace

PoseEdges poseEdges(const Graph& graph) {
  PoseEdges edges;
  for (const auto& [id, record] : graph.variables()) {
    const bool planar = record.kind->kind() == "se2";
    if (!planar && record.kind->kind() != "se3") continue;
    edges.index.emplace(id, static_cast<int>(edges.poses.size()));
    const Se3 pose = planar ? inSpace(se2FromValue(record.value.data())) : se3FromValue(record.value.data());
    edges.poses.push_back({id, pose, planar, record.fixed});
  }
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight == 0) continue;
    addBetween<BetweenSe2>(record, edges) || addBetween<BetweenSe3>(record, edges) ||
        addPrior<PriorSe2>(record, edges) || addPrior<PriorSe3>(record, edges);
  }
  return edges;
}

void storePoses(const PoseEdges& edges, Graph& graph) {
  for (const PoseEdges::Pose& pose : edges.poses) {
    if (pose.fixed) continue;
    if (pose.planar)
      graph.setValue(pose.id, toValue(geometry::project(pose.map_from_pose)));
    else
      graph.setValue(pose.id, toValue(pose.map_from_pose));
  }
  std::map<base::VariableId, std::pair<Eigen::VectorXd, int>> sums;
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight == 0) continue;
    const Eigen::VectorXd seen = seenInMap(record, edges);
    if (seen.size() == 0) continue;
    auto& [sum, count] = sums.emplace(record.variables[1], std::make_pair(0 * seen, 0)).first->second;
    sum += seen;
    ++count;
  }
  for (const auto& [id, sum] : sums)
    if (!graph.variable(id).fixed) graph.setValue(id, sum.first / sum.second);
}

}  // namespace omnimapper::graph
