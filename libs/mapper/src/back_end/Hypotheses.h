#pragma once

#include <omnimapper/graph/Consistency.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/DecisionLog.h>

#include <unordered_map>
#include <vector>

namespace omnimapper::mapper {

/// Keeps track of the hypotheses, factors that would distort the map if they were wrong, from the batch that adds them
/// to their verdict and to a later one that revokes it. They have no weight until they are tested. Every verdict is
/// logged.
class Hypotheses {
 public:
  explicit Hypotheses(const graph::ConsistencyOptions& options) : options_(options) {}

  /// Adds the hypotheses of a batch that was just applied; its decisions are the last of `decisions`.
  void take(const Batch& batch, const AppliedBatch& applied, graph::Graph& graph, DecisionLog& decisions);
  /// Whether any hypothesis waits for its verdict.
  bool anyFresh() const { return !fresh_.empty(); }
  /// Tests the hypotheses, lets the minimizer solve `graph` with those that are consistent, and logs the verdicts.
  void solve(graph::Graph& graph, const graph::SolveOptions& solve_options, graph::Minimizer& minimizer,
             const map::Map& map, DecisionLog& decisions);

 private:
  void log(const graph::HypothesisVerdict& verdict, const graph::FactorRecord& record, const map::Map& map,
           DecisionLog& decisions);

  graph::ConsistencyOptions options_;
  std::vector<base::FactorId> fresh_;
  std::unordered_map<base::FactorId, std::size_t> decision_of_;  // index in the log
};

}  // namespace omnimapper::mapper
