#include "TestedClosures.h"

#include <algorithm>
#include <utility>

#include "LoopSearch.h"
#include "SlipSearch.h"

namespace omnimapper::plugins {

void TestedClosures::add(const std::vector<base::FactorId>& factors) {
  for (const auto id : factors) closures_.push_back({id, false, false});
}

void TestedClosures::noteSolves(std::size_t solves) {
  if (solves == solves_) return;
  solves_ = solves;
  for (auto& closure : closures_) closure.is_tested = true;
}

// Stamp of the later key frame of a factor.
std::optional<base::Stamp> TestedClosures::stampOf(const graph::FactorRecord& record) const {
  std::optional<base::Stamp> newest;
  for (const auto variable : record.variables) {
    const auto found = stamp_of_.find(variable);
    if (found != stamp_of_.end()) newest = std::max(newest.value_or(found->second), found->second);
  }
  return newest;
}

std::optional<base::Stamp> TestedClosures::newestTied(const graph::Graph& graph) const {
  std::optional<base::Stamp> newest;
  for (const auto& closure : closures_) {
    if (!graph.contains(closure.id)) continue;
    const auto& record = graph.factor(closure.id);
    if (record.tags.hypothesis && record.weight > 0) newest = std::max(newest, stampOf(record));
  }
  return newest;
}

std::optional<base::Stamp> TestedClosures::newestWithNote(const graph::Graph& graph, const std::string& note) const {
  std::optional<base::Stamp> newest;
  for (const auto& closure : closures_) {
    if (graph.contains(closure.id) && graph.factor(closure.id).tags.note == note)
      newest = std::max(newest, stampOf(graph.factor(closure.id)));
  }
  return newest;
}

std::vector<base::FactorId> TestedClosures::refusedGlobally(const graph::Graph& graph) const {
  std::vector<base::FactorId> refused;
  for (const auto& closure : closures_) {
    if (!closure.is_tested || !graph.contains(closure.id)) continue;
    const auto& record = graph.factor(closure.id);
    if (record.weight == 0 && record.tags.note == kGlobalClosure) refused.push_back(closure.id);
  }
  return refused;
}

std::vector<base::FactorId> TestedClosures::between(std::uint16_t session, const graph::Graph& graph) const {
  std::vector<base::FactorId> all;
  for (const auto& closure : closures_) {
    if (!graph.contains(closure.id) || !graph.factor(closure.id).tags.hypothesis) continue;
    const auto& variables = graph.factor(closure.id).variables;
    const auto isOwn = [&](base::VariableId id) { return id.session == session; };
    const auto own = std::count_if(variables.begin(), variables.end(), isOwn);
    if (own > 0 && own < static_cast<std::ptrdiff_t>(variables.size())) all.push_back(closure.id);
  }
  return all;
}

mapper::Batch TestedClosures::proposedAgain(const mapper::State& state, const std::string& section) {
  mapper::Batch batch;
  bool is_corrected = false;
  for (auto& closure : closures_) {
    if (closure.is_settled || !closure.is_tested || !state.graph.contains(closure.id)) continue;
    if (state.graph.factor(closure.id).tags.note != kSlip) continue;
    closure.is_settled = is_corrected = true;
    ++corrections_;
  }
  if (!is_corrected) return batch;
  const auto& frames = state.map.key_frames;
  const auto frameOf = [&](base::VariableId pose) {
    return std::find_if(frames.begin(), frames.end(), [&](const auto& frame) { return frame.pose == pose; });
  };
  for (const auto id : refusedGlobally(state.graph)) {
    auto record = state.graph.factor(id);
    const auto place = frameOf(record.variables.front()), newest = frameOf(record.variables.back());
    if (place == frames.end() || newest == frames.end()) continue;
    mapper::Decision decision(*newest, section, "loop closure");
    decision.is_loop_closure = true;
    decision.to = place->id;
    decision.reason = "proposed again after a slip was corrected";
    record.weight = 1;
    batch.removeFactor(id);
    batch.addHypothesis(std::move(record), std::move(decision));
  }
  return batch;
}

}  // namespace omnimapper::plugins
