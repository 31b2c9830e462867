#include "OutlierModel.h"

#include <Eigen/LU>
#include <cmath>

#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

OutlierModel::OutlierModel(const Graph& graph) {
  constexpr double kFar = 1e300;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kFar), high = -low;
  for (const auto& [id, record] : graph.variables()) {
    const int axes = record.kind == se2() ? 2 : record.kind == se3() ? 3 : 0;
    low.head(axes) = low.head(axes).cwiseMin(record.value.head(axes));
    high.head(axes) = high.head(axes).cwiseMax(record.value.head(axes));
  }
  size_ = (high - low).cwiseMax(1);
}

std::optional<double> OutlierModel::logOf(const FactorRecord& record) const {
  const auto volume = record.factor->outlierVolume(size_);
  if (!volume) return std::nullopt;
  return std::log(*volume * std::abs(record.noise.matrix().determinant()));
}

}  // namespace omnimapper::graph
