#include <omnimapper/mapper/Batch.h>

namespace omnimapper::mapper {

base::VariableId Batch::addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value) {
  added_variables_.push_back({std::move(kind), value});
  return {kProvisionalSession, static_cast<std::uint32_t>(added_variables_.size() - 1)};
}

}  // namespace omnimapper::mapper
