#include "sessions/removeForbidden.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>

namespace omnimapper::mapper {

namespace {

/// Whether a variable is fixed, or a factor has influence on it.
bool isBound(const graph::Graph& graph, base::VariableId variable) {
  const auto& factors = graph.factorsOf(variable);
  return graph.variable(variable).fixed ||
         std::any_of(factors.begin(), factors.end(), [&](auto factor) { return graph.factor(factor).weight > 0; });
}

/// Whether the map can be read again: every direction of both poses, and of all else that factors bind, is determined.
/// That factors connect two parts is not enough: poses that see one wall can slide along it.
bool isDetermined(const graph::Graph& graph, base::VariableId from, base::VariableId to) {
  if (!isBound(graph, from) || !isBound(graph, to)) return false;
  try {
    const graph::Marginals marginals(graph);
    return true;
  } catch (const base::Error&) {
    return false;
  }
}

/// The hypotheses that tie two poses.
std::vector<base::FactorId> loopsBetween(const graph::Graph& graph, base::VariableId a, base::VariableId b) {
  std::vector<base::FactorId> loops;
  for (const auto id : graph.factorsOf(a)) {
    const auto& record = graph.factor(id);
    const bool is_between = record.variables.size() == 2 && (record.variables[0] == b || record.variables[1] == b);
    if (is_between && record.tags.hypothesis) loops.push_back(id);
  }
  return loops;
}

void solve(derived::SavedMap& saved, const graph::SolveOptions& options) {
  graph::solve(saved.graph, options);
  auto& frames = saved.map.key_frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    auto& frame = frames.edit(frames[i].id);
    frame.map_from_base = poseOf(saved.graph, frame.pose);
  }
}

}  // namespace

ForbiddenLoops removeForbidden(derived::SavedMap& saved, const graph::SolveOptions& options) {
  ForbiddenLoops found;
  const auto* corrections = saved.map.layers.find<map::Corrections>();
  if (!corrections) return found;
  for (const auto& forbidden : corrections->forbidden) {
    const auto from = saved.map.keyFrame(forbidden.from).pose, to = saved.map.keyFrame(forbidden.to).pose;
    const auto loops = loopsBetween(saved.graph, from, to);
    if (loops.empty()) continue;
    graph::Graph without = saved.graph;
    for (const auto id : loops) without.removeFactor(id);
    const std::string which =
        "the loop closure between the key frames " + toString(forbidden.from) + " and " + toString(forbidden.to);
    if (isDetermined(without, from, to)) {
      saved.graph = std::move(without);
      found.removed.push_back(which + " was forbidden, and is removed");
    } else {
      found.kept.push_back(which + " was forbidden, but stays: without it, a part of the map would be loose");
    }
  }
  if (!found.removed.empty()) solve(saved, options);
  return found;
}

}  // namespace omnimapper::mapper
