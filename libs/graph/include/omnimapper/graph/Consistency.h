#pragma once

#include <optional>
#include <string>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// The one test that decides which hypotheses act. A hypothesis is a factor with tags.hypothesis; weight 0 keeps it out
/// of the solution, weight 1 lets it act. Everything else in the graph is trusted.
/// Sources: Mangelson et al., ICRA 2018 (pairwise consistency maximisation); Yang et al., RA-L 2020 (graduated
/// non-convexity); Latif et al., IJRR 2013 (RRR: taking back); Suenderhauf and Protzel, IROS 2012 (Vertigo: how such
/// tests are tried).
struct ConsistencyOptions {
  enum class Method {
    none,      ///< every hypothesis acts
    pairwise,  ///< the largest set that agrees pair by pair
    graduated  ///< graduated non-convexity with truncated least squares
  };
  Method method = Method::pairwise;
  /// A true hypothesis passes a gate with this probability.
  double confidence = 0.999;
  /// Factor on the standard deviations of what the graph says before the hypothesis: odometry is surer of itself than
  /// it should be.
  double inflation = 1;
  /// A hypothesis acts when what it measures is so many times likelier if it is true than if it is false and lies
  /// anywhere in the map; else it waits for another that bears it out.
  double min_likelihood_ratio = 100;
};

/// What was decided about one hypothesis, and why.
struct Verdict {
  base::FactorId factor;
  bool accepted = false;
  bool changed = false;                   ///< other than before the test
  double chi2 = 0;                        ///< what the decision looked at
  double bound = 0;                       ///< of chi2, for one that fits
  int degrees_of_freedom = 0;             ///< of chi2
  std::string reason;                     ///< in words for the user; the numbers stand beside it
  std::optional<base::FactorId> against;  ///< the hypothesis that it contradicts, where it is one
};

/// Decides about the hypotheses of a graph: the `fresh` ones, which came since the last test, and older ones that what
/// is known now puts in another light. Sets their weights to 0 or 1 and solves. The values should be an estimate worth
/// having of what acts; where nothing is refused, the test costs little more than solve().
/// What it knows stands in the graph: the same graph, fresh ones and options give the same verdicts, in every bit.
/// Returns a verdict for each fresh one, in their order, then for each older one that changed, in the order of ids.
/// Throws Error(internal) as solve() does, and if a fresh one does not exist or is no hypothesis.
std::vector<Verdict> testConsistency(Graph& graph, const std::vector<base::FactorId>& fresh,
                                     const ConsistencyOptions& options = {}, const SolveOptions& solve_options = {});

}  // namespace omnimapper::graph
