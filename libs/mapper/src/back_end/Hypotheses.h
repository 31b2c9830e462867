#pragma once

#include <omnimapper/graph/Consistency.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/DecisionLog.h>

#include <unordered_map>
#include <vector>

namespace omnimapper::mapper {

/// The factors that could bend the map if they were wrong, from the batch that brings them to the verdict, and to a
/// later one that takes it back. Until they are judged they do not act. Every verdict goes to the decision log.
class Hypotheses {
 public:
  explicit Hypotheses(const graph::ConsistencyOptions& options) : options_(options) {}

  /// Takes up those of a batch that was just applied; its decisions are the last of `decisions`.
  void take(const Batch& batch, const AppliedBatch& applied, graph::Graph& graph, DecisionLog& decisions);
  /// Whether some wait for their verdict.
  bool anyFresh() const { return !fresh_.empty(); }
  /// Solves `graph` with what is found consistent, and says so in the log.
  void solve(graph::Graph& graph, const graph::SolveOptions& solve_options, const map::Map& map,
             DecisionLog& decisions);

 private:
  void log(const graph::Verdict& verdict, const graph::FactorRecord& record, const map::Map& map,
           DecisionLog& decisions);

  graph::ConsistencyOptions options_;
  std::vector<base::FactorId> fresh_;
  std::unordered_map<base::FactorId, std::size_t> decision_of_;  // place in the log
};

}  // namespace omnimapper::mapper
