#pragma once

#include <optional>
#include <vector>

#include "RevisionTrial.h"

namespace omnimapper::graph {

/// Judges refused hypotheses that agree with one another against those that act. If a solution with them shows that
/// they fit beside all that acts, they act too. If they are more than the acting ones that they contradict, and the
/// graph without those has room for them and fits better as a whole, they act in their place. This is tried only when a
/// `refused` hypothesis, which came last, makes such a group reach two, four, eight, ... members among the `refused`
/// and the `waiting` ones. The graph should be solved; it is changed, and solved again, only if there is a result.
/// Source: after Latif et al., IJRR 2013 (RRR), where groups of closures are judged against one another.
std::optional<RevisedHypotheses> reviseHypotheses(Graph& graph, const std::vector<base::FactorId>& refused,
                                                  const std::vector<base::FactorId>& waiting, const Gate& gate,
                                                  double inflation, const SolveOptions& solve_options);

}  // namespace omnimapper::graph
