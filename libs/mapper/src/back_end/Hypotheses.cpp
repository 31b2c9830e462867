#include "back_end/Hypotheses.h"

#include <omnimapper/graph/Solver.h>

#include <algorithm>

namespace omnimapper::mapper {

namespace {

// The log entry for a hypothesis that came without a decision or was made in an earlier session.
Decision decisionAbout(base::FactorId id, const graph::FactorRecord& record, const map::Map& map) {
  Decision decision;
  decision.plugin = record.tags.owner;
  decision.kind = record.tags.note.empty() ? "hypothesis" : record.tags.note;
  decision.hypothesis = id;
  if (!map.key_frames.empty()) {
    decision.from = map.key_frames.back().id;
    decision.stamp = map.key_frames.back().stamp;
  }
  return decision;
}

}  // namespace

void Hypotheses::take(const Batch& batch, const AppliedBatch& applied, graph::Graph& graph, DecisionLog& decisions) {
  const bool test = options_.method != graph::ConsistencyOptions::Method::none;
  const std::size_t first_decision = decisions.size() - batch.decisions().size();
  for (std::size_t i = 0; i < batch.decisions().size(); ++i) {
    auto& decision = decisions[first_decision + i];
    if (!decision.hypothesis) continue;
    decision.hypothesis = applied.factors.at(decision.hypothesis->index);
    decision_of_[*decision.hypothesis] = first_decision + i;
    decision.accepted = !test;
  }
  for (std::size_t i = 0; i < batch.addedFactors().size(); ++i) {
    if (!batch.addedFactors()[i].tags.hypothesis) continue;
    if (test) graph.setWeight(applied.factors[i], 0);
    fresh_.push_back(applied.factors[i]);
  }
}

void Hypotheses::solve(graph::Graph& graph, const graph::SolveOptions& solve_options, graph::Minimizer& minimizer,
                       const map::Map& map, DecisionLog& decisions) {
  fresh_.erase(std::remove_if(fresh_.begin(), fresh_.end(), [&](auto id) { return !graph.contains(id); }),
               fresh_.end());
  auto options = solve_options;
  options.stop = nullptr;
  if (solve_options.stop && solve_options.stop()) {
    // The run is being stopped: the test is skipped, because an interrupted solve is no basis for a verdict.
    constexpr int kLastIterations = 5;
    options.max_iterations = std::min(options.max_iterations, kLastIterations);
    minimizer.minimize(graph, options);
    for (const auto id : fresh_) {
      const auto entry = decision_of_.find(id);
      if (entry != decision_of_.end()) decisions[entry->second].reason = "not judged: the run was interrupted";
    }
    return;
  }
  for (const auto& verdict : graph::testConsistency(graph, fresh_, options_, options, minimizer)) {
    log(verdict, graph.factor(verdict.factor), map, decisions);
  }
  fresh_.clear();
}

// The decision that came with the hypothesis holds its latest verdict; a verdict that changes is also logged as a new
// entry.
void Hypotheses::log(const graph::HypothesisVerdict& verdict, const graph::FactorRecord& record, const map::Map& map,
                     DecisionLog& decisions) {
  const auto entry = decision_of_.find(verdict.factor);
  const bool fresh = std::find(fresh_.begin(), fresh_.end(), verdict.factor) != fresh_.end();
  const auto complete = [&](Decision& decision) {
    decision.accepted = verdict.accepted;
    decision.reason = verdict.reason;
    decision.numbers.emplace_back("chi-square", verdict.chi2);
    decision.numbers.emplace_back("bound of chi-square", verdict.bound);
    if (!verdict.against) return;
    const auto other = decision_of_.find(*verdict.against);
    if (other == decision_of_.end()) return;
    decision.numbers.emplace_back("contradicts that of key frame", decisions[other->second].from.index);
  };
  if (entry != decision_of_.end()) {
    Decision& decision = decisions[entry->second];
    if (!fresh) {
      Decision change = decision;
      change.kind += verdict.accepted ? ", accepted after all" : ", taken back";
      change.is_loop_closure = false;  // the entry that it changes already counts as one
      change.numbers.clear();
      complete(change);
      if (!map.key_frames.empty()) change.stamp = map.key_frames.back().stamp;
      decision.accepted = verdict.accepted;
      decision.reason = verdict.reason;
      change.hypothesis.reset();
      decisions.push_back(std::move(change));
    } else {
      complete(decision);
    }
    return;
  }
  decisions.push_back(decisionAbout(verdict.factor, record, map));
  complete(decisions.back());
  decision_of_[verdict.factor] = decisions.size() - 1;
}

}  // namespace omnimapper::mapper
