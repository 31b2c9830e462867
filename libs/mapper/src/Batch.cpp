#include <omnimapper/base/Error.h>
#include <omnimapper/mapper/Batch.h>

#include <cmath>
#include <set>

namespace omnimapper::mapper {

namespace {

void refuse(const std::string& edit, const std::string& why) {
  throw base::Error(base::ExitCode::internal, "batch: " + edit + ": " + why + "; the graph is as it was");
}

graph::FactorRecord bound(graph::FactorRecord record, const std::vector<base::VariableId>& final_ids) {
  for (auto& id : record.variables) {
    if (!Batch::isProvisional(id)) continue;
    if (id.index >= final_ids.size())
      refuse("added factor", "binds a provisional variable that the batch does not add");
    id = final_ids[id.index];
  }
  return record;
}

// What can be seen to fail before anything is touched.
void check(const Batch& batch, const graph::Graph& graph) {
  std::set<base::FactorId> removed;
  for (const auto id : batch.removedFactors()) {
    if (!graph.contains(id)) refuse("removed factor " + base::toString(id), "the graph has none of that id");
    if (!removed.insert(id).second) refuse("removed factor " + base::toString(id), "is removed twice");
  }
  for (const auto& [id, weight] : batch.weights()) {
    if (!graph.contains(id)) refuse("weight of factor " + base::toString(id), "the graph has none of that id");
    if (!(weight >= 0) || std::isinf(weight))
      refuse("weight of factor " + base::toString(id), "is negative or not finite");
  }
}

}  // namespace

bool Batch::empty() const {
  return added_variables_.empty() && added_factors_.empty() && removed_factors_.empty() && weights_.empty() &&
         decisions_.empty();
}

base::VariableId Batch::addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value,
                                    bool fixed) {
  added_variables_.push_back({std::move(kind), value, fixed});
  return {kProvisionalSession, static_cast<std::uint32_t>(added_variables_.size() - 1)};
}

AppliedBatch apply(const Batch& batch, graph::Graph& graph) {
  check(batch, graph);
  AppliedBatch applied;
  try {
    for (const auto& variable : batch.addedVariables()) {
      applied.variables.push_back(graph.addVariable(variable.kind, variable.value, variable.fixed));
    }
    for (const auto& record : batch.addedFactors()) {
      applied.factors.push_back(graph.addFactor(bound(record, applied.variables)));
    }
  } catch (...) {
    for (const auto id : applied.factors) graph.removeFactor(id);
    for (const auto id : applied.variables) graph.removeVariable(id);
    throw;
  }
  for (const auto& [id, weight] : batch.weights()) graph.setWeight(id, weight);
  for (const auto id : batch.removedFactors()) graph.removeFactor(id);
  return applied;
}

}  // namespace omnimapper::mapper
