#pragma once

#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Graph.h>

#include <memory>
#include <string_view>
#include <vector>

namespace omnimapper::plugins {

/// A weak prior on a variable of any kind, at a given value. Variable: one of that kind. Residual: the tangent from the
/// given value to the current one [rad, m]. The factor is used only in copies of a graph and is never written to a
/// file.
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

/// Adds a weak prior at the variable's current value, with a standard deviation of 100 [rad, m] in each direction: too
/// weak to change what is measured, and enough to constrain the variable when its measurements have no weight.
void addWeakPrior(graph::Graph& graph, base::VariableId id);

}  // namespace omnimapper::plugins
