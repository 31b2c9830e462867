#include "omnimapper/graph/IncrementalSmoother.h"

#include <omnimapper/base/Error.h>

#include <set>

namespace omnimapper::graph {

void IncrementalSmoother::follow(const Graph& graph) {
  const GraphChanges changes = changesBetween(followed_, graph);
  if (!changes.empty()) update(graph, changes);
}

/// Returns whether all variables are determined; if not, the next update begins anew with the whole graph.
bool IncrementalSmoother::update(const Graph& graph, const GraphChanges& changes) {
  try {
    solver_.update(graph, changes);
    followed_ = graph;
    is_determined_ = true;
  } catch (const base::Error&) {
    solver_ = IncrementalSolver(options_);
    followed_ = Graph();
    is_determined_ = false;
  }
  return is_determined_;
}

std::optional<Marginals> IncrementalSmoother::marginals(const Graph& graph) {
  follow(graph);
  if (!is_determined_) return std::nullopt;
  return solver_.marginals(graph);
}

/// Takes the changes and steps until no variable is far from where it is linearized. Returns whether that came about.
bool IncrementalSmoother::settle(Graph& trial) {
  constexpr int kMost = 10;
  GraphChanges changes = changesBetween(followed_, trial);
  for (int i = 0; i < kMost; ++i) {
    if (!update(trial, changes)) return false;
    changes = {};
    if (!solver_.isSettled()) continue;
    solver_.storeComputed(trial);
    followed_ = trial;
    return true;
  }
  return false;
}

namespace {

/// What the cost of a graph rises by with the values of another, of those factors whose variables differ.
double riseOfCost(const Graph& before, const Graph& after) {
  std::set<base::FactorId> affected;
  for (const auto variable : changesBetween(before, after).moved)
    affected.insert(after.factorsOf(variable).begin(), after.factorsOf(variable).end());
  double rise = 0;
  for (const auto id : affected) {
    const FactorRecord& record = after.factor(id);
    if (record.weight == 0) continue;
    const auto costIn = [&](const Graph& graph) {
      return 0.5 * record.weight * record.loss.evaluate(graph.whitenedResidual(id).squaredNorm()).rho;
    };
    rise += costIn(after) - costIn(before);
  }
  return rise;
}

}  // namespace

void IncrementalSmoother::minimize(Graph& graph, const SolveOptions& options) {
  // Half of chi-square: so little is what steps leave that linearize no variable anew, and means nothing.
  constexpr double kNoRise = 0.01;
  Graph trial = graph;
  if (settle(trial) && riseOfCost(graph, trial) <= kNoRise)
    graph = std::move(trial);
  else
    solve(graph, options);
}

}  // namespace omnimapper::graph
