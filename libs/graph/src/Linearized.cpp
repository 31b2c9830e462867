#include "omnimapper/graph/Linearized.h"

#include "BoundFactor.h"

namespace omnimapper::graph {

Linearized::Linearized(const Graph& graph, const FactorRecord& record) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const BoundFactor bound(graph, record);
  std::vector<RowMatrix> blocks(record.variables.size());
  std::vector<const double*> values;
  std::vector<double*> pointers;
  std::vector<int> strides;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const int size = bound.tangentSize(static_cast<int>(i));
    blocks[i].resize(bound.residualSize(), size);
    values.push_back(graph.value(record.variables[i]).data());
    pointers.push_back(blocks[i].data());
    strides.push_back(size);
  }
  residual.resize(bound.residualSize());
  bound.evaluate(values.data(), residual.data(), pointers.data(), strides.data());
  jacobians.assign(blocks.begin(), blocks.end());
}

}  // namespace omnimapper::graph
