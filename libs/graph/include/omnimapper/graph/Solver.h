#pragma once

#include <functional>
#include <string>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

struct SolveOptions {
  enum class Method { levenberg_marquardt, dogleg };
  /// Dogleg needs fewer factorizations where the minimum lies in a curved valley; see doc/results/graph.md.
  Method method = Method::dogleg;
  int max_iterations = 100;
  /// The solver has converged when a step lowers the cost by less than this fraction of the cost.
  double function_tolerance = 1e-9;
  /// Called after each iteration; if it returns true, solve() ends with the best values so far (Ctrl-C).
  std::function<bool()> stop;
};

struct SolveSummary {
  int iterations = 0;
  double initial_cost = 0;  ///< Graph::cost() before solving
  double final_cost = 0;    ///< Graph::cost() after solving
  bool converged = false;
  std::string reason;  ///< why the solver ended, in words
};

/// Moves the values of the variables to a minimum of the cost. It uses one thread, so that not a bit of the result
/// depends on the machine. Fixed variables, and variables that no factor of positive weight binds, keep their values.
/// If the solver does not converge, that is no error; the summary reports it. Throws Error(internal), naming a
/// variable, if a connected part of the graph has neither a fixed variable nor a factor of a single variable (a prior).
SolveSummary solve(Graph& graph, const SolveOptions& options = {});

/// One way to move the variables of a graph to a minimum of its cost.
class Minimizer {
 public:
  virtual ~Minimizer() = default;
  /// Throws as solve() does.
  virtual void minimize(Graph& graph, const SolveOptions& options) = 0;
};

/// solve(), which has no memory of earlier calls.
class BatchMinimizer : public Minimizer {
 public:
  void minimize(Graph& graph, const SolveOptions& options) override { solve(graph, options); }
};

}  // namespace omnimapper::graph
