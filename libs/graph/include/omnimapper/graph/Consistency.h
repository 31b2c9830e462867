#pragma once

#include <optional>
#include <string>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Options of the test that decides which hypotheses act. A hypothesis is a factor with tags.hypothesis; with weight 0
/// the solver ignores it, with weight 1 it acts. The test trusts every other factor of the graph.
/// Sources: Mangelson et al., ICRA 2018 (pairwise consistency maximization); Yang et al., RA-L 2020 (graduated
/// non-convexity); Latif et al., IJRR 2013 (RRR: revising earlier decisions); Suenderhauf and Protzel, IROS 2012
/// (Vertigo: how such tests are evaluated).
struct ConsistencyOptions {
  enum class Method {
    none,      ///< every hypothesis acts
    pairwise,  ///< the largest set that agrees pair by pair
    graduated  ///< graduated non-convexity with truncated least squares
  };
  Method method = Method::pairwise;
  /// A true hypothesis passes a gate with this probability.
  double confidence = 0.999;
  /// Factor on the standard deviations that the graph predicts without the hypothesis. Odometry usually reports smaller
  /// ones than it should.
  double inflation = 1;
  /// A hypothesis acts if its measurement is at least this many times likelier when it is true than when it is false,
  /// where it could lie anywhere in the map; otherwise it waits for another hypothesis that supports it.
  double min_likelihood_ratio = 100;
};

/// What was decided about one hypothesis, and why.
struct Verdict {
  base::FactorId factor;
  bool accepted = false;
  bool changed = false;                   ///< the decision differs from that before the test
  double chi2 = 0;                        ///< chi-square on which the decision is based
  double bound = 0;                       ///< largest chi2 of a hypothesis that fits
  int degrees_of_freedom = 0;             ///< of chi2
  std::string reason;                     ///< in words for the user; the numbers are in the fields above
  std::optional<base::FactorId> against;  ///< the hypothesis that it contradicts, if it contradicts one
};

/// Decides about the hypotheses of a graph: the `fresh` ones, which were added since the last test, and older ones
/// whose verdict changes with the new information. Sets their weights to 0 or 1 and solves. The values of the graph
/// should already be a good estimate for the acting factors; if nothing is refused, the test costs little more than
/// solve(). The test is stateless: the same graph, fresh hypotheses and options give bit-identical verdicts.
/// Returns a verdict for each fresh hypothesis, in their order, then for each older one that changed, in order of ids.
/// Throws Error(internal) as solve() does, and if a fresh factor does not exist or is not a hypothesis.
std::vector<Verdict> testConsistency(Graph& graph, const std::vector<base::FactorId>& fresh,
                                     const ConsistencyOptions& options = {}, const SolveOptions& solve_options = {});

}  // namespace omnimapper::graph
