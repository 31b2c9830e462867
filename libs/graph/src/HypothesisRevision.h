#pragma once

#include <optional>
#include <vector>

#include "RevisionTrial.h"

namespace omnimapper::graph {

/// Refused hypotheses that agree with one another, against those that act. If a solution with them shows that they fit
/// after all, they act. If they are more than what stands against them, and the graph without that has room for them
/// and fits better as a whole, they act in its place. Looked at when a `refused` one, which came last, makes such a
/// group reach two, four, eight, ... members among itself and the `waiting` ones. The graph should be solved; it is
/// changed and solved again only where the answer is not none. Source: after Latif et al., IJRR 2013 (RRR): groups of
/// closures judged against one another.
std::optional<RevisedHypotheses> reviseHypotheses(Graph& graph, const std::vector<base::FactorId>& refused,
                                                  const std::vector<base::FactorId>& waiting, const Gate& gate,
                                                  double inflation, const SolveOptions& solve_options);

}  // namespace omnimapper::graph
