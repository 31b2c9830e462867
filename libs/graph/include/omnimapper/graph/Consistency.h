#pragma once

#include <optional>
#include <string>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Options of the test that decides which hypotheses act. A hypothesis is a factor with tags.hypothesis. With weight 0
/// the solver ignores it, with weight 1 it acts. The test trusts every other factor of the graph. Sources: Mangelson et
/// al., ICRA 2018 (pairwise consistency maximization); Yang et al., RA-L 2020 (graduated non-convexity); Latif et al.,
/// IJRR 2013 (RRR: revising earlier decisions); Suenderhauf and Protzel, IROS 2012 (Vertigo: how such tests are
/// evaluated).
struct ConsistencyOptions {
  enum class Method {
    none,      ///< every hypothesis acts
    pairwise,  ///< the largest set acts in which every two hypotheses agree
    graduated  ///< all are weighed together: graduated non-convexity with truncated least squares
  };
  Method method = Method::pairwise;
  /// Probability with which a true hypothesis passes a gate.
  double confidence = 0.999;
  /// Factor on the standard deviations that the graph predicts without the hypothesis, because odometry usually reports
  /// smaller standard deviations than it has.
  double inflation = 1;
  /// A hypothesis acts only if its measurement is at least this many times likelier if the hypothesis is true than if
  /// it is false and the measurement could lie anywhere in the map. Otherwise the hypothesis waits for another one that
  /// supports it.
  double min_likelihood_ratio = 100;
};

/// What was decided about one hypothesis, and why.
struct HypothesisVerdict {
  base::FactorId factor;
  bool accepted = false;
  bool changed = false;                   ///< the decision differs from the one before the test
  double chi2 = 0;                        ///< chi-square on which the decision is based
  double bound = 0;                       ///< largest `chi2` with which a hypothesis fits
  int degrees_of_freedom = 0;             ///< degrees of freedom of `chi2`
  std::string reason;                     ///< the reason in words for the user, without the numbers above
  std::optional<base::FactorId> against;  ///< another hypothesis that this one contradicts, if there is one
};

/// Decides about the hypotheses of a graph: the `fresh` ones, which were added since the last test, and older ones
/// whose verdict changes with the new information. Sets the weights of the hypotheses to 0 or 1 and solves. The values
/// of the graph should already be a good estimate for the acting factors; if nothing is refused, the test costs little
/// more than one call of the minimizer, which solves the graph; copies for trials are solved by solve(). The test has
/// no state beside that of the minimizer: the same graph, fresh hypotheses and options give bit-identical verdicts.
/// Returns a verdict for each fresh hypothesis, in the order of `fresh`, then for each older hypothesis whose verdict
/// changed, in the order of ids. Throws Error(internal) as solve() does, and if a fresh factor does not exist or is not
/// a hypothesis.
std::vector<HypothesisVerdict> testConsistency(Graph& graph, const std::vector<base::FactorId>& fresh,
                                               const ConsistencyOptions& options, const SolveOptions& solve_options,
                                               Minimizer& minimizer);
/// The same with BatchMinimizer.
std::vector<HypothesisVerdict> testConsistency(Graph& graph, const std::vector<base::FactorId>& fresh,
                                               const ConsistencyOptions& options = {},
                                               const SolveOptions& solve_options = {});

}  // namespace omnimapper::graph
