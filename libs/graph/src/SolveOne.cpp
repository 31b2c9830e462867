#include <omnimapper/graph/SolveOne.h>

#include <Eigen/Cholesky>
#include <vector>

#include "BoundFactor.h"

namespace omnimapper::graph {

namespace {

// The factors of one variable as a function of its value.
class Neighbourhood {
 public:
  Neighbourhood(const Graph& graph, base::VariableId id) : graph_(graph), id_(id) {
    for (const auto factor : graph.factorsOf(id)) factors_.emplace_back(graph, graph.factor(factor));
  }

  // Cost at `value`; where asked, the normal equations information * step = -gradient of the reweighted problem.
  double evaluate(const Eigen::VectorXd& value, Eigen::MatrixXd* information, Eigen::VectorXd* gradient) const {
    double cost = 0;
    for (const auto& factor : factors_) {
      const FactorRecord& record = factor.record();
      std::vector<const double*> values;
      std::size_t own = 0;
      for (std::size_t i = 0; i < record.variables.size(); ++i) {
        if (record.variables[i] == id_) own = i;
        values.push_back(record.variables[i] == id_ ? value.data() : graph_.value(record.variables[i]).data());
      }
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
      const auto loss = record.loss.evaluate(residual.squaredNorm());
      cost += 0.5 * record.weight * loss.rho;
      if (!information) continue;
      const double weight = record.weight * loss.first_derivative;
      *information += weight * jacobian.transpose() * jacobian;
      *gradient += weight * jacobian.transpose() * residual;
    }
    return cost;
  }

 private:
  const Graph& graph_;
  base::VariableId id_;
  std::vector<BoundFactor> factors_;
};

}  // namespace

void solveOne(Graph& graph, base::VariableId id) {
  const VariableRecord& variable = graph.variable(id);
  if (variable.fixed || variable.factors.empty()) return;
  const Neighbourhood factors(graph, id);
  const int size = variable.kind->tangentSize();
  Eigen::VectorXd value = variable.value;
  double damping = 0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    const double cost = factors.evaluate(value, &information, &gradient);
    const double scale = information.diagonal().maxCoeff();
    if (!(scale > 0)) break;
    information.diagonal().array() += (damping + 1e-12) * scale;
    const Eigen::VectorXd step = information.ldlt().solve(-gradient);
    Eigen::VectorXd moved = value;
    variable.kind->plus(value.data(), step.data(), moved.data());
    const double new_cost = moved.allFinite() ? factors.evaluate(moved, nullptr, nullptr) : cost;
    if (!(new_cost < cost)) {
      if (damping > 1e3) break;
      damping = damping == 0 ? 1e-4 : 10 * damping;
      continue;
    }
    value = moved;
    damping *= 0.1;
    if (cost - new_cost < 1e-9 * (1 + cost)) break;
  }
  graph.setValue(id, value);
}

}  // namespace omnimapper::graph
