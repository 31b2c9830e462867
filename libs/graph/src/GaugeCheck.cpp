#include "GaugeCheck.h"

#include <omnimapper/base/Error.h>

#include <unordered_set>
#include <vector>

namespace omnimapper::graph {

namespace {

using base::VariableId;

/// Adds all variables to `reached` that can be reached from the given ones over factors of positive weight.
void flood(const Graph& graph, std::vector<VariableId> open, std::unordered_set<VariableId>& reached) {
  while (!open.empty()) {
    const VariableId id = open.back();
    open.pop_back();
    for (const base::FactorId factor : graph.factorsOf(id)) {
      const FactorRecord& record = graph.factor(factor);
      if (record.weight == 0) continue;
      for (const VariableId next : record.variables)
        if (reached.insert(next).second) open.push_back(next);
    }
  }
}

}  // namespace

std::optional<VariableId> unconstrainedVariable(const Graph& graph) {
  std::unordered_set<VariableId> reached;
  std::vector<VariableId> tied;
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight == 0) continue;
    for (const VariableId variable : record.variables) {
      const bool is_held = record.variables.size() == 1 || graph.variable(variable).fixed;
      if (is_held && reached.insert(variable).second) tied.push_back(variable);
    }
  }
  flood(graph, std::move(tied), reached);
  for (const auto& [id, record] : graph.factors())
    if (record.weight > 0 && reached.count(record.variables[0]) == 0) return record.variables[0];
  return std::nullopt;
}

void checkGauge(const Graph& graph) {
  if (const auto variable = unconstrainedVariable(graph))
    throw base::Error(base::ExitCode::internal,
                      "graph: variable " + toString(*variable) +
                          " and the variables connected to it are not constrained: fix one of them or add a prior");
}

}  // namespace omnimapper::graph
