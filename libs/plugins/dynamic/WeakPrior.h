#pragma once

#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Graph.h>

#include <memory>
#include <string_view>
#include <vector>

namespace omnimapper::plugins {

/// A weak prior of a variable of any kind at its current value. Variable: of that kind. Residual: what takes the kept
/// value to its value, in its tangent [rad, m]. For copies of a graph alone: no file has it.
class WeakPrior : public graph::Factor {
 public:
  WeakPrior(std::shared_ptr<const graph::Variable> variable, const Eigen::VectorXd& value);

  std::string_view kind() const override { return "loose_hold"; }
  int residualSize() const override { return variable_->tangentSize(); }
  const std::vector<std::string_view>& variableKinds() const override { return kinds_; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;

 private:
  std::shared_ptr<const graph::Variable> variable_;
  std::vector<std::string_view> kinds_;
  Eigen::VectorXd value_;
};

/// Holds a variable so loosely, with a standard deviation of 100 in each direction, that nothing which is measured
/// gives way, and so that nothing hangs free once what measured it no longer counts.
void addWeakPrior(graph::Graph& graph, base::VariableId id);

}  // namespace omnimapper::plugins
