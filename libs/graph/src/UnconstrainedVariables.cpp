#include "UnconstrainedVariables.h"

#include <algorithm>

#include "omnimapper/graph/SolveOne.h"

namespace omnimapper::graph {

namespace {

bool isConstrained(const Graph& graph, base::VariableId id) {
  const VariableRecord& variable = graph.variable(id);
  return variable.fixed || std::any_of(variable.factors.begin(), variable.factors.end(),
                                       [&](base::FactorId factor) { return graph.factor(factor).weight > 0; });
}

}  // namespace

bool bindsUnconstrained(const Graph& graph, base::FactorId factor) {
  const std::vector<base::VariableId>& variables = graph.factor(factor).variables;
  return std::any_of(variables.begin(), variables.end(),
                     [&](base::VariableId id) { return !isConstrained(graph, id); });
}

void initializeUnconstrained(Graph& graph, base::FactorId factor) {
  std::vector<base::VariableId> unconstrained;
  for (const base::VariableId id : graph.factor(factor).variables)
    if (!isConstrained(graph, id)) unconstrained.push_back(id);
  graph.setWeight(factor, 1);
  for (const base::VariableId id : unconstrained) solveOne(graph, id);
}

}  // namespace omnimapper::graph
