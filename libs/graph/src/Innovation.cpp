#include "Innovation.h"

#include <omnimapper/geometry/Angle.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "omnimapper/graph/Linearized.h"

namespace omnimapper::graph {

namespace {

/// The variables of some factors, with their offsets in one stacked tangent.
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

double InnovationStatistics::chi2() const {
  return residual.dot(covariance.llt().solve(residual));
}

double InnovationStatistics::logDensity() const {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const double log_determinant = 2 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
  return -0.5 * (residual.dot(root.solve(residual)) + log_determinant +
                 static_cast<double>(residual.size()) * std::log(2 * geometry::kPi));
}

Innovation::Innovation(const Graph& graph, const Marginals& marginals, std::vector<base::FactorId> factors,
                       double inflation)
    : factors_(std::move(factors)) {
  const Places places(graph, factors_);
  for (const base::FactorId id : factors_) rows_.push_back(rows_.back() + graph.factor(id).factor->residualSize());
  residual_.resize(rows_.back());
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows_.back(), places.size);
  for (int i = 0; i < size(); ++i) {
    const Linearized linearized(graph, factors_[i]);
    residual_.segment(rows_[i], degreesOfFreedom(i)) = linearized.residual;
    const FactorRecord& record = graph.factor(factors_[i]);
    weights_.push_back(record.weight * record.loss.evaluate(linearized.residual.squaredNorm()).first_derivative);
    const std::vector<base::VariableId>& variables = graph.factor(factors_[i]).variables;
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (const auto place = places.offsets.find(variables[k]); place != places.offsets.end())
        jacobian.block(rows_[i], place->second, degreesOfFreedom(i), linearized.jacobians[k].cols()) =
            linearized.jacobians[k];
  }
  covariance_ = Eigen::MatrixXd::Identity(rows_.back(), rows_.back());
  if (places.size > 0)
    covariance_ +=
        inflation * inflation * jacobian * marginals.jointCovariance(places.variables) * jacobian.transpose();
}

InnovationStatistics Innovation::of(const std::vector<int>& some) const {
  int rows = 0;
  for (const int i : some) rows += degreesOfFreedom(i);
  InnovationStatistics all{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, rows)};
  int row = 0;
  for (const int i : some) {
    all.residual.segment(row, degreesOfFreedom(i)) = residual(i);
    int column = 0;
    for (const int j : some) {
      all.covariance.block(row, column, degreesOfFreedom(i), degreesOfFreedom(j)) = covariance(i, j);
      column += degreesOfFreedom(j);
    }
    row += degreesOfFreedom(i);
  }
  return all;
}

Eigen::MatrixXd Innovation::crossCovariance(int i, const std::vector<int>& others) const {
  int columns = 0;
  for (const int j : others) columns += degreesOfFreedom(j);
  Eigen::MatrixXd cross(degreesOfFreedom(i), columns);
  int column = 0;
  for (const int j : others) {
    cross.middleCols(column, degreesOfFreedom(j)) = covariance(i, j);
    column += degreesOfFreedom(j);
  }
  return cross;
}

InnovationStatistics Innovation::given(int i, const std::vector<int>& others) const {
  if (others.empty()) return of(i);
  const InnovationStatistics known = of(others);
  const Eigen::MatrixXd cross = crossCovariance(i, others);
  const Eigen::LLT<Eigen::MatrixXd> root(known.covariance);
  return {residual(i) - cross * root.solve(known.residual), covariance(i, i) - cross * root.solve(cross.transpose())};
}

void Innovation::withdraw(const std::vector<int>& acting) {
  // Removing factors of weight w from the information matrix adds cov J^T (1/w - J cov J^T)^-1 J cov to its inverse; a
  // robust loss makes the weight smaller. Directions that they alone determine have no information left; a small number
  // is used instead of zero.
  constexpr double kNothing = 1e-9;
  if (acting.empty()) return;
  const InnovationStatistics acts = of(acting);
  Eigen::MatrixXd columns(residual_.size(), acts.residual.size());
  int column = 0;
  for (const int j : acting) {
    columns.middleCols(column, degreesOfFreedom(j)) = covariance_.middleCols(rows_[j], degreesOfFreedom(j));
    column += degreesOfFreedom(j);
  }
  Eigen::MatrixXd left = -acts.covariance;  // 1/w - (covariance - I)
  left.diagonal().array() += 1 + kNothing;
  column = 0;
  for (const int j : acting) {
    left.diagonal().segment(column, degreesOfFreedom(j)).array() += 1 / std::max(weights_[j], kNothing);
    column += degreesOfFreedom(j);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(left);
  residual_ += columns * root.solve(acts.residual);
  covariance_ += columns * root.solve(columns.transpose());
}

void Innovation::condition(int i) {
  const Eigen::MatrixXd column = covariance_.middleCols(rows_[i], degreesOfFreedom(i));
  const Eigen::LLT<Eigen::MatrixXd> own(covariance(i, i));
  residual_ -= column * own.solve(residual(i).eval());
  covariance_ -= column * own.solve(column.transpose());
}

}  // namespace omnimapper::graph
