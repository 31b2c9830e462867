#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PanTiltOffsets.h>

#include <memory>

namespace omnimapper::mapper {

std::optional<base::VariableId> PanTiltOffsets::find(const std::string& label, Batch& batch) {
  if (sigma_ == 0) return std::nullopt;
  if (const auto known = variables_.find(label); known != variables_.end()) return known->second;
  const auto id = batch.addVariable(graph::panTilt(), Eigen::Vector2d::Zero());
  graph::FactorRecord prior{{id},
                            std::make_shared<graph::PriorPanTilt>(Eigen::Vector2d::Zero()),
                            graph::SquareRootInformation::fromSigmas(Eigen::Vector2d::Constant(sigma_))};
  prior.tags.owner = owner_;
  prior.tags.note = "pan and tilt offsets of '" + label + "'";
  batch.addFactor(std::move(prior));
  return variables_[label] = id;
}

void PanTiltOffsets::applied(const AppliedBatch& ids) {
  for (auto& [label, id] : variables_) {
    if (Batch::isProvisional(id)) id = ids.variables.at(id.index);
  }
}

Eigen::Vector2d PanTiltOffsets::estimate(std::optional<base::VariableId> id, const graph::Graph& graph) {
  if (!id || Batch::isProvisional(*id)) return Eigen::Vector2d::Zero();
  return graph.value(*id);
}

}  // namespace omnimapper::mapper
