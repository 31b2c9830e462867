#pragma once

#include <optional>

#include "omnimapper/graph/IncrementalSolver.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Minimizes one graph again and again while others edit it in any way: it sees by itself what changed, and follows the
/// minimum with an IncrementalSolver. Where that fails, because the start is bad or a part of the graph is not
/// determined, or where it raises the cost by more than 0.01 (half of chi-square, which means nothing), solve() is used
/// instead.
class IncrementalSmoother : public Minimizer {
 public:
  explicit IncrementalSmoother(const IncrementalOptions& options = {}) : options_(options), solver_(options) {}

  /// Takes into the tree what changed since the last call. It does not change the graph, and spreads the work over the
  /// time between two solutions.
  void follow(const Graph& graph);
  /// Only values that change are written. `options` are those of the solve() that is used where the tree fails.
  void minimize(Graph& graph, const SolveOptions& options) override;

  /// Covariances where the tree is linearized, no farther from the graph's values than IncrementalOptions say. None
  /// where the tree does not determine every variable.
  std::optional<Marginals> marginals(const Graph& graph);

 private:
  bool update(const Graph& graph, const GraphChanges& changes);
  bool settle(Graph& trial);

  IncrementalOptions options_;
  IncrementalSolver solver_;
  Graph followed_;  // as the tree knows it
  bool is_determined_ = false;
};

}  // namespace omnimapper::graph
