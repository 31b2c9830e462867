#include <Eigen/LU>

#include "omnimapper/graph/G2o.h"

namespace omnimapper::graph {

namespace {

/// The whitened residual with twice the quaternion's vector part in place of the rotation vector.
double squaredNorm(const Graph& graph, base::FactorId id, const FactorRecord& record) {
  const Eigen::VectorXd whitened = graph.whitenedResidual(id);
  if (record.factor->kind() != "between_se3" && record.factor->kind() != "prior_se3") return whitened.squaredNorm();
  Eigen::VectorXd error = record.noise.matrix().partialPivLu().solve(whitened);
  const double angle = error.tail<3>().norm();
  if (angle > 0) error.tail<3>() *= 2 * std::sin(0.5 * angle) / angle;
  return (record.noise.matrix() * error).squaredNorm();
}

}  // namespace

double g2oChi2(const Graph& graph) {
  double sum = 0;
  for (const auto& [id, record] : graph.factors()) sum += record.weight * squaredNorm(graph, id, record);
  return sum;
}

}  // namespace omnimapper::graph
