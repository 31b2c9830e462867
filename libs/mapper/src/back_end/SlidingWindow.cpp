#include "back_end/SlidingWindow.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <optional>

namespace omnimapper::mapper {

namespace {

struct Belief {
  mrpt::poses::CPose3D map_from_base;
  geometry::Matrix6d covariance;  // in the tangent at that pose
};

// The marginal of `neighbour` by the factors of `gone` alone, without those that bind a third free variable. None if
// they leave a direction of `neighbour` undetermined.
std::optional<Belief> marginalOf(base::VariableId neighbour, base::VariableId gone, const graph::Graph& graph) {
  graph::Graph part;
  std::vector<std::pair<base::VariableId, base::VariableId>> copies;  // (id in graph, id in part)
  const auto copyOf = [&](base::VariableId id) {
    const auto known = std::find_if(copies.begin(), copies.end(), [&](const auto& pair) { return pair.first == id; });
    if (known != copies.end()) return known->second;
    const auto& variable = graph.variable(id);
    copies.emplace_back(id, part.addVariable(variable.kind, variable.value, variable.fixed));
    return copies.back().second;
  };
  const auto neighbour_copy = copyOf(neighbour);
  for (const auto id : graph.factorsOf(gone)) {
    auto record = graph.factor(id);
    const bool binds_others = std::any_of(record.variables.begin(), record.variables.end(), [&](auto other) {
      return other != gone && other != neighbour && !graph.variable(other).fixed;
    });
    if (record.weight == 0 || binds_others) continue;
    for (auto& variable : record.variables) variable = copyOf(variable);
    part.addFactor(std::move(record));
  }
  try {
    graph::solve(part);
    const Eigen::MatrixXd covariance = graph::Marginals(part).covariance(neighbour_copy);
    return Belief{poseOf(part, neighbour_copy), covariance.rows() == 3
                                                    ? geometry::embedPlanar(Eigen::Matrix3d(covariance))
                                                    : geometry::Matrix6d(covariance)};
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

}  // namespace

void SlidingWindow::holdMap() {
  std::vector<base::FactorId> factors;
  for (const auto& [id, record] : graph_.factors()) factors.push_back(id);
  for (const auto id : factors) graph_.removeFactor(id);
  std::vector<base::VariableId> variables;
  for (const auto& [id, record] : graph_.variables()) variables.push_back(id);
  for (const auto id : variables) graph_.setFixed(id, true);
  held_ = of_map_ = map_.key_frames.size();
}

bool SlidingWindow::mayRetire() const {
  constexpr std::size_t kStanding = 10;  // key frames after the one that aligned the session
  const auto& session = map_.sessions.back();
  if (hasRetired()) return true;
  if (!session.aligned) return false;
  if (!session.aligned_at || !map_.key_frames.find(*session.aligned_at)) return true;
  return map_.key_frames.position(*session.aligned_at) + kStanding < map_.key_frames.size();
}

std::vector<base::KeyFrameId> SlidingWindow::retire(base::Stamp stamp) {
  std::vector<base::KeyFrameId> retired;
  if (!mayRetire()) return retired;
  while (map_.key_frames.size() > held_ + size_ && map_.key_frames[held_ + 1].stamp < stamp) {
    if (!hasRetired()) retireAnchor();
    const auto id = map_.key_frames[held_].id;
    retire(map_.keyFrame(id).pose, map_.key_frames[held_ + 1].pose);
    map_.key_frames.edit(id).observations.clear();
    map_.key_frames.edit(id).cloud.clear();
    retired.push_back(id);
    ++held_;
  }
  return retired;
}

// The session's start is tied to the first pose that came: retires the start.
void SlidingWindow::retireAnchor() {
  const auto anchor = map_.sessions.back().anchor;
  const auto factors = graph_.factorsOf(anchor);
  for (const auto id : factors) {
    const auto variables = graph_.factor(id).variables;
    for (const auto neighbour : variables) {
      if (neighbour != anchor && !graph_.variable(neighbour).fixed) return retire(anchor, neighbour);
    }
  }
}

void SlidingWindow::retire(base::VariableId gone, base::VariableId neighbour) {
  constexpr char kOwner[] = "engine";
  // Standard deviation if the factors leave a direction undetermined.
  constexpr double kAnywhere = 1e3;
  const auto belief =
      marginalOf(neighbour, gone, graph_)
          .value_or(Belief{poseOf(graph_, neighbour), kAnywhere * kAnywhere * geometry::Matrix6d::Identity()});
  const std::vector<base::FactorId> factors = graph_.factorsOf(gone);
  for (const auto id : factors) graph_.removeFactor(id);
  graph_.setFixed(gone, true);
  graph_.addFactor(posePrior(motion_, neighbour, belief.map_from_base, belief.covariance, kOwner));
}

}  // namespace omnimapper::mapper
