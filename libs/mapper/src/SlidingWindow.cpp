#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/mapper/PoseFactors.h>
#include <omnimapper/mapper/SlidingWindow.h>

#include <algorithm>
#include <optional>

namespace omnimapper::mapper {

namespace {

struct Belief {
  mrpt::poses::CPose3D map_from_base;
  geometry::Matrix6d covariance;  // in the tangent there
};

// What the factors of `gone`, and they alone, say of `heir`. Those that bind a third free variable are left out. None
// if they leave a direction of it open.
std::optional<Belief> marginalOf(base::VariableId heir, base::VariableId gone, const graph::Graph& graph) {
  graph::Graph part;
  std::vector<std::pair<base::VariableId, base::VariableId>> copies;  // in the graph, in the part
  const auto copyOf = [&](base::VariableId id) {
    const auto known = std::find_if(copies.begin(), copies.end(), [&](const auto& pair) { return pair.first == id; });
    if (known != copies.end()) return known->second;
    const auto& variable = graph.variable(id);
    copies.emplace_back(id, part.addVariable(variable.kind, variable.value, variable.fixed));
    return copies.back().second;
  };
  const auto heir_copy = copyOf(heir);
  for (const auto id : graph.factorsOf(gone)) {
    auto record = graph.factor(id);
    const bool speaks_of_others = std::any_of(record.variables.begin(), record.variables.end(), [&](auto other) {
      return other != gone && other != heir && !graph.variable(other).fixed;
    });
    if (record.weight == 0 || speaks_of_others) continue;
    for (auto& variable : record.variables) variable = copyOf(variable);
    part.addFactor(std::move(record));
  }
  try {
    graph::solve(part);
    const Eigen::MatrixXd covariance = graph::Marginals(part).covariance(heir_copy);
    return Belief{poseOf(part, heir_copy), covariance.rows() == 3 ? geometry::embedPlanar(Eigen::Matrix3d(covariance))
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
  held_ = map_.key_frames.size();
}

std::vector<base::KeyFrameId> SlidingWindow::retire(base::Stamp stamp) {
  std::vector<base::KeyFrameId> retired;
  const auto& session = map_.sessions.back();
  while (session.joined && map_.key_frames.size() > held_ + size_ && map_.key_frames[held_ + 1].stamp < stamp) {
    const auto id = map_.key_frames[held_].id;
    const auto pose = map_.keyFrame(id).pose;
    // The first pose hangs on where the session began.
    if (!graph_.variable(session.anchor).fixed) retire(session.anchor, pose);
    retire(pose, map_.key_frames[held_ + 1].pose);
    map_.key_frames.edit(id).observations.clear();
    retired.push_back(id);
    ++held_;
  }
  return retired;
}

void SlidingWindow::retire(base::VariableId gone, base::VariableId heir) {
  constexpr char kOwner[] = "engine";
  const auto belief = marginalOf(heir, gone, graph_);
  const std::vector<base::FactorId> factors = graph_.factorsOf(gone);
  for (const auto id : factors) graph_.removeFactor(id);
  graph_.setFixed(gone, true);
  if (belief) graph_.addFactor(posePrior(motion_, heir, belief->map_from_base, belief->covariance, kOwner));
}

}  // namespace omnimapper::mapper
