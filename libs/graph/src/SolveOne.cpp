#include <omnimapper/graph/SolveOne.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>
#include <vector>

#include "BoundFactor.h"

namespace omnimapper::graph {

namespace {

enum class Losses { as_recorded, none };

// The factors of one variable as a function of its value.
class Neighbourhood {
 public:
  Neighbourhood(const Graph& graph, base::VariableId id) : graph_(graph), id_(id) {
    for (const auto factor : graph.factorsOf(id)) factors_.emplace_back(graph, graph.factor(factor));
  }

  // The cost at `value`. Unless `information` is null, adds the normal equations information * step = -gradient of the
  // reweighted problem.
  double evaluate(const Eigen::VectorXd& value, Losses losses, Eigen::MatrixXd* information,
                  Eigen::VectorXd* gradient) const {
    double cost = 0;
    for (const auto& factor : factors_) {
      const FactorRecord& record = factor.record();
      const auto values = valuesOf(record, value);
      const auto own = static_cast<std::size_t>(std::find(record.variables.begin(), record.variables.end(), id_) -
                                                record.variables.begin());
      const int rows = factor.residualSize(), columns = factor.tangentSize(static_cast<int>(own));
      Eigen::VectorXd residual(rows);
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, columns);
      std::vector<double*> jacobians(values.size(), nullptr);
      std::vector<int> strides(values.size(), 0);
      if (information) {
        jacobians[own] = jacobian.data();
        strides[own] = columns;
      }
      factor.evaluate(values.data(), residual.data(), information ? jacobians.data() : nullptr, strides.data());
      const auto loss = (losses == Losses::none ? Loss::none() : record.loss).evaluate(residual.squaredNorm());
      cost += 0.5 * record.weight * loss.rho;
      if (!information) continue;
      const double weight = record.weight * loss.first_derivative;
      *information += weight * jacobian.transpose() * jacobian;
      *gradient += weight * jacobian.transpose() * residual;
    }
    return cost;
  }

  // Whether the loss of some factor takes away more than half of its weight.
  bool hasOutlier(const Eigen::VectorXd& value) const {
    return std::any_of(factors_.begin(), factors_.end(), [&](const BoundFactor& factor) {
      if (!(factor.record().weight > 0)) return false;
      Eigen::VectorXd residual(factor.residualSize());
      const auto values = valuesOf(factor.record(), value);
      factor.evaluate(values.data(), residual.data(), nullptr, nullptr);
      return factor.record().loss.evaluate(residual.squaredNorm()).first_derivative < 0.5;
    });
  }

 private:
  std::vector<const double*> valuesOf(const FactorRecord& record, const Eigen::VectorXd& value) const {
    std::vector<const double*> values;
    for (const auto id : record.variables) values.push_back(id == id_ ? value.data() : graph_.value(id).data());
    return values;
  }

  const Graph& graph_;
  base::VariableId id_;
  std::vector<BoundFactor> factors_;
};

// The minimum of the cost that is found by descent from `value`, and its cost.
std::pair<Eigen::VectorXd, double> descend(const Neighbourhood& factors, const Variable& kind, Eigen::VectorXd value,
                                           Losses losses) {
  const int size = kind.tangentSize();
  double damping = 0, least = factors.evaluate(value, losses, nullptr, nullptr);
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    const double cost = factors.evaluate(value, losses, &information, &gradient);
    const double scale = information.diagonal().maxCoeff();
    if (!(scale > 0)) break;
    information.diagonal().array() += (damping + 1e-12) * scale;
    const Eigen::VectorXd step = information.ldlt().solve(-gradient);
    Eigen::VectorXd moved = value;
    kind.plus(value.data(), step.data(), moved.data());
    const double new_cost = moved.allFinite() ? factors.evaluate(moved, losses, nullptr, nullptr) : cost;
    if (!(new_cost < cost)) {
      if (damping > 1e3) break;
      damping = damping == 0 ? 1e-4 : 10 * damping;
      continue;
    }
    value = moved;
    least = new_cost;
    damping *= 0.1;
    if (cost - new_cost < 1e-9 * (1 + cost)) break;
  }
  return {value, least};
}

}  // namespace

void solveOne(Graph& graph, base::VariableId id) {
  const VariableRecord& variable = graph.variable(id);
  if (variable.fixed || variable.factors.empty()) return;
  const Neighbourhood factors(graph, id);
  const Variable& kind = *variable.kind;
  auto found = descend(factors, kind, variable.value, Losses::as_recorded);
  // Robust losses have several local minima: from a bad initial value, a correct measurement looks like an outlier. The
  // minimum without losses is therefore tried as a second initial value.
  if (factors.hasOutlier(found.first)) {
    const auto together = descend(factors, kind, variable.value, Losses::none);
    auto other = descend(factors, kind, together.first, Losses::as_recorded);
    if (other.second < found.second) found = std::move(other);
  }
  graph.setValue(id, found.first);
}

}  // namespace omnimapper::graph
