#include "Innovation.h"

#include <Eigen/Cholesky>
#include <unordered_map>

#include "BoundFactor.h"

namespace omnimapper::graph {

namespace {

/// Where the tangents of the variables of some factors stand in one vector.
struct Places {
  std::vector<base::VariableId> variables;
  std::unordered_map<base::VariableId, int> offsets;
  int size = 0;

  Places(const Graph& graph, const std::vector<base::FactorId>& factors) {
    for (const base::FactorId factor : factors)
      for (const base::VariableId id : graph.factor(factor).variables) {
        if (graph.variable(id).fixed || !offsets.emplace(id, size).second) continue;
        variables.push_back(id);
        size += graph.variable(id).kind->tangentSize();
      }
  }
};

}  // namespace

Innovation::Innovation(const Graph& graph, const Marginals& marginals, std::vector<base::FactorId> factors,
                       double inflation)
    : factors_(std::move(factors)) {
  const Places places(graph, factors_);
  for (const base::FactorId id : factors_) rows_.push_back(rows_.back() + graph.factor(id).factor->residualSize());
  residual_.resize(rows_.back());
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMatrix jacobian = RowMatrix::Zero(rows_.back(), places.size);
  for (int i = 0; i < size(); ++i) {
    const FactorRecord& record = graph.factor(factors_[i]);
    const BoundFactor bound(graph, record);
    std::vector<const double*> values;
    std::vector<double*> jacobians;
    for (const base::VariableId id : record.variables) {
      values.push_back(graph.value(id).data());
      const auto place = places.offsets.find(id);
      jacobians.push_back(place == places.offsets.end() ? nullptr : &jacobian(rows_[i], place->second));
    }
    const std::vector<int> strides(values.size(), places.size);
    bound.evaluate(values.data(), residual_.data() + rows_[i], jacobians.data(), strides.data());
  }
  covariance_ = Eigen::MatrixXd::Identity(rows_.back(), rows_.back());
  if (places.size > 0)
    covariance_ +=
        inflation * inflation * jacobian * marginals.jointCovariance(places.variables) * jacobian.transpose();
}

double Innovation::chi2(int i) const {
  return residual(i).dot(covariance(i, i).llt().solve(residual(i)));
}

double Innovation::chi2(int i, int j) const {
  const int a = degreesOfFreedom(i), b = degreesOfFreedom(j);
  Eigen::VectorXd both(a + b);
  both << residual(i), residual(j);
  Eigen::MatrixXd spread(a + b, a + b);
  spread << covariance(i, i), covariance(i, j), covariance(j, i), covariance(j, j);
  return both.dot(spread.llt().solve(both));
}

double Innovation::vagueness(int i) const {
  return 2 * Eigen::MatrixXd(covariance(i, i).llt().matrixL()).diagonal().array().log().sum();
}

void Innovation::condition(int i) {
  const Eigen::MatrixXd column = covariance_.middleCols(rows_[i], degreesOfFreedom(i));
  const Eigen::LLT<Eigen::MatrixXd> own(covariance(i, i));
  residual_ -= column * own.solve(residual(i).eval());
  covariance_ -= column * own.solve(column.transpose());
}

}  // namespace omnimapper::graph
