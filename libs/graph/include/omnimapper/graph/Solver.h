#pragma once

#include <functional>
#include <string>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

struct SolveOptions {
  enum class Method { levenberg_marquardt, dogleg };
  /// Dogleg takes fewer factorisations where the valley is curved; see doc/results/graph.md.
  Method method = Method::dogleg;
  int max_iterations = 100;
  /// Converged when a step lowers the cost by less than this part of it.
  double function_tolerance = 1e-9;
  /// Asked after each iteration; true ends the solution with the best values so far (Ctrl-C).
  std::function<bool()> stop;
};

struct SolveSummary {
  int iterations = 0;
  double initial_cost = 0;  ///< Graph::cost() before
  double final_cost = 0;    ///< Graph::cost() after
  bool converged = false;
  std::string reason;  ///< why it ended, in words
};

/// Moves the values of the variables to a minimum of the cost. One thread, so that bits do not depend on the machine.
/// Fixed variables, and variables that no factor of positive weight binds, stay as they are. Not to converge is no
/// error; the summary says so.
/// Throws Error(internal), naming a variable, if a connected part of the graph hangs free: no fixed variable in it and
/// no factor of a single variable (a prior).
SolveSummary solve(Graph& graph, const SolveOptions& options = {});

}  // namespace omnimapper::graph
