#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <memory>

namespace omnimapper::mapper {

std::optional<base::VariableId> SensorCorrections::find(const std::string& label, base::KeyFrameId frame,
                                                        Batch& batch) {
  if (trust_.estimate == SensorPoseTrust::Estimate::no) return std::nullopt;
  const bool once = trust_.estimate == SensorPoseTrust::Estimate::once;
  const Key key(label, once ? std::optional<base::KeyFrameId>() : frame);
  if (const auto known = variables_.find(key); known != variables_.end()) return known->second;
  const auto id = batch.addVariable(graph::se3(), graph::toValue(geometry::Se3()));
  graph::FactorRecord prior{{id},
                            std::make_shared<graph::PriorSe3>(geometry::Se3()),
                            graph::SquareRootInformation::fromCovariance(priorCovariance())};
  prior.tags.owner = owner_;
  prior.tags.note = "place of sensor '" + label + "' on the base";
  batch.addFactor(std::move(prior));
  return variables_[key] = id;
}

void SensorCorrections::applied(const AppliedBatch& ids) {
  for (auto& [key, id] : variables_) {
    if (Batch::isProvisional(id)) id = ids.variables.at(id.index);
  }
}

geometry::Se3 SensorCorrections::estimate(std::optional<base::VariableId> id, const graph::Graph& graph) {
  if (!id || Batch::isProvisional(*id)) return {};
  return graph::se3FromValue(graph.value(*id).data());
}

geometry::Matrix6d SensorCorrections::priorCovariance() const {
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  if (trust_.estimate == SensorPoseTrust::Estimate::no) return covariance;
  covariance.diagonal().head<3>().setConstant(trust_.position_sigma * trust_.position_sigma);
  covariance.diagonal().tail<3>().setConstant(trust_.angle_sigma * trust_.angle_sigma);
  return covariance;
}

}  // namespace omnimapper::mapper
