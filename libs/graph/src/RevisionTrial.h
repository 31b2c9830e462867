#pragma once

#include <vector>

#include "Selection.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// The hypotheses whose state a revision changed.
struct RevisedHypotheses {
  std::vector<base::FactorId> accepted, taken_back;
};

/// A copy of a graph in which a group of refused hypotheses acts, beside the acting ones or in place of some of them,
/// the suspects.
class RevisionTrial {
 public:
  RevisionTrial(const Graph& graph, const Gate& gate, double inflation, const SolveOptions& solve_options)
      : graph_(graph), gate_(gate), inflation_(inflation), solve_options_(solve_options) {}

  /// Whether most of the group can act in the graph without the suspects; they, and the others of the pool that can act
  /// beside them, are more than the suspects that then no longer fit; and the graph as a whole fits better. The pool
  /// holds all refused hypotheses, including the group.
  bool succeeds(const std::vector<base::FactorId>& group, const std::vector<base::FactorId>& pool,
                const std::vector<base::FactorId>& suspects);
  /// Whether the group can act beside all that acts, by the rise of chi-square in a solution with it: where the graph
  /// is poorly determined, the linear gate is wrong and this is not. The limit of the rise is the bound of one member,
  /// plus the expected noise of the others.
  bool fitsBeside(const std::vector<base::FactorId>& group);
  /// Whether a hypothesis that could be there by chance fits, and others of the pool, which could not be tested before,
  /// fit once it acts. Where the graph is poorly determined, the effect of one hypothesis on another is not linear: a
  /// rotation by 45 degrees at the end of a long path moves the next sign by metres.
  bool isConfirmed(base::FactorId id, const std::vector<base::FactorId>& pool);
  /// After success: the graph, solved before suspects that fit again were let in, and the changes.
  Graph& graph() { return graph_; }
  const RevisedHypotheses& outcome() const { return outcome_; }

 private:
  double bound(base::FactorId id) const { return gate_.bound(graph_.factor(id).factor->residualSize()); }
  double misfit(base::FactorId id) const { return graph_.whitenedResidual(id).squaredNorm(); }
  double truncatedCost(const std::vector<base::FactorId>& some) const;
  bool admit(const std::vector<base::FactorId>& pool);

  Graph graph_;
  const Gate& gate_;
  double inflation_;
  const SolveOptions& solve_options_;
  RevisedHypotheses outcome_;
};

}  // namespace omnimapper::graph
