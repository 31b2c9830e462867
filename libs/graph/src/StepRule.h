#pragma once

#include <Eigen/Core>
#include <memory>

#include "NormalEquations.h"
#include "SparseCholesky.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Chooses the step from the normal equations at the current values, and how far the quadratic model is trusted.
class StepRule {
 public:
  virtual ~StepRule() = default;
  /// Called when the equations were linearized at new values.
  virtual void moved() = 0;
  /// Sets `step` and the decrease of the cost that the model predicts for it. Returns false if there is no step.
  virtual bool propose(NormalEquations& equations, Eigen::VectorXd& step, double& predicted) = 0;
  /// `ratio` is the decrease of the cost / the predicted one; by it, the model is trusted more or less.
  virtual void judge(double ratio) = 0;
};

std::unique_ptr<StepRule> makeStepRule(SolveOptions::Method method, const NormalEquations& equations);

}  // namespace omnimapper::graph
