#pragma once

#include <vector>

#include "Selection.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// What refused hypotheses overturned.
struct RevisedHypotheses {
  std::vector<base::FactorId> accepted, taken_back;
};

/// A copy of a graph in which a group of refused hypotheses is put in place of suspects that act.
class RevisionTrial {
 public:
  RevisionTrial(const Graph& graph, const Gate& gate, double inflation, const SolveOptions& solve_options)
      : graph_(graph), gate_(gate), inflation_(inflation), solve_options_(solve_options) {}

  /// True if the graph without the suspects has room for most of the group, if those that then act, and the others of
  /// the pool that can act beside them, are more than the suspects that then no longer fit, and if the graph as a whole
  /// fits better. The pool holds what is refused, the group included.
  bool succeeds(const std::vector<base::FactorId>& group, const std::vector<base::FactorId>& pool,
                const std::vector<base::FactorId>& suspects);
  /// True if the group can act beside all that acts, by the rise of chi-square of a solution with it: where the graph
  /// is wide open, the linear gate is wrong and this is not. The rise is held against the bound of one of the group and
  /// what noise makes of the others.
  bool fitsBeside(const std::vector<base::FactorId>& group);
  /// True if one that could be there by chance fits, and once it acts others of the pool lie where they must, which
  /// nobody could tell before. Where the graph is wide open, what one says of another is not linear: a turn by half a
  /// right angle at the end of a long way moves the next sign by metres.
  bool isBorneOut(base::FactorId id, const std::vector<base::FactorId>& pool);
  /// After success: the graph, solved but for suspects that fit again, and what changed.
  Graph& graph() { return graph_; }
  const RevisedHypotheses& outcome() const { return outcome_; }

 private:
  double bound(base::FactorId id) const { return gate_.bound(graph_.factor(id).factor->residualSize()); }
  double misfit(base::FactorId id) const { return graph_.whitenedResidual(id).squaredNorm(); }
  double truncatedCost(const std::vector<base::FactorId>& some) const;
  bool letIn(const std::vector<base::FactorId>& pool);

  Graph graph_;
  const Gate& gate_;
  double inflation_;
  const SolveOptions& solve_options_;
  RevisedHypotheses outcome_;
};

}  // namespace omnimapper::graph
