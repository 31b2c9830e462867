#include "sessions/removeForbidden.h"

#include <omnimapper/map/Corrections.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <unordered_set>

namespace omnimapper::mapper {

namespace {

/// Whether factors with weight lead from one variable to the other.
bool areTied(const graph::Graph& graph, base::VariableId from, base::VariableId to) {
  std::unordered_set<base::VariableId> reached{from};
  std::vector<base::VariableId> next{from};
  while (!next.empty() && reached.count(to) == 0) {
    const auto variable = next.back();
    next.pop_back();
    for (const auto factor : graph.factorsOf(variable)) {
      if (graph.factor(factor).weight <= 0) continue;
      for (const auto other : graph.factor(factor).variables)
        if (reached.insert(other).second) next.push_back(other);
    }
  }
  return reached.count(to) > 0;
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
    if (areTied(without, from, to)) {
      saved.graph = std::move(without);
      found.removed.push_back(which + " was forbidden, and is removed");
    } else {
      found.kept.push_back(which + " was forbidden, but stays: nothing else ties the two parts of the map together");
    }
  }
  if (!found.removed.empty()) solve(saved, options);
  return found;
}

}  // namespace omnimapper::mapper
