#include "WeakPrior.h"

#include <omnimapper/graph/ByteIo.h>

namespace omnimapper::plugins {

WeakPrior::WeakPrior(std::shared_ptr<const graph::Variable> variable, const Eigen::VectorXd& value)
    : variable_(std::move(variable)), kinds_{variable_->kind()}, value_(value) {}

void WeakPrior::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  variable_->minus(values[0], value_.data(), residual);
  if (!jacobians || !jacobians[0]) return;
  // Variables have no derivative of minus(), so it is computed by central differences.
  constexpr double kStep = 1e-6;
  const int size = variable_->tangentSize();
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(jacobians[0], size, size);
  const auto changeAfter = [&](int column, double step) {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(size), moved(variable_->ambientSize()), change(size);
    delta[column] = step;
    variable_->plus(values[0], delta.data(), moved.data());
    variable_->minus(moved.data(), value_.data(), change.data());
    return change;
  };
  for (int column = 0; column < size; ++column)
    jacobian.col(column) = (changeAfter(column, kStep) - changeAfter(column, -kStep)) / (2 * kStep);
}

void WeakPrior::write(std::ostream& out) const {
  for (const double number : value_) graph::writeDouble(out, number);
}

void addWeakPrior(graph::Graph& graph, base::VariableId id) {
  constexpr double kSigma = 100;  // [rad, m]
  const graph::VariableRecord& variable = graph.variable(id);
  const Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(variable.kind->tangentSize(), kSigma);
  graph.addFactor({{id},
                   std::make_shared<WeakPrior>(variable.kind, variable.value),
                   graph::SquareRootInformation::fromSigmas(sigmas)});
}

}  // namespace omnimapper::plugins
