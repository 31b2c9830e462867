#include "OutlierModel.h"

#include <omnimapper/geometry/Angle.h>

#include <Eigen/LU>
#include <cmath>

#include "omnimapper/graph/PointFactor.h"
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
  const double pi = geometry::kPi;
  double volume = 0, odds = 1;
  if (record.factor->kind() == "between_se2") {
    volume = size_.x() * size_.y() * 2 * pi;
  } else if (record.factor->kind() == "between_se3") {
    volume = size_.prod() * 8 * pi * pi;  // of the rotation group in rotation vectors
  } else if (record.factor->kind() == SamePointFactor::kKind) {
    volume = size_.prod();
    odds = dynamic_cast<const SamePointFactor&>(*record.factor).odds();
  } else {
    return std::nullopt;
  }
  return std::log(odds * volume * std::abs(record.noise.matrix().determinant()));
}

}  // namespace omnimapper::graph
