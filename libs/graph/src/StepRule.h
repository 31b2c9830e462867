#pragma once

#include <Eigen/Core>
#include <memory>

#include "NormalEquations.h"
#include "SparseCholesky.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

/// Which step to take from the normal equations at one place, and how far the quadratic model is trusted there.
class StepRule {
 public:
  virtual ~StepRule() = default;
  /// The equations were linearised at a new place.
  virtual void moved() = 0;
  /// Sets `step` and the decrease of the cost that the model promises for it; false if there is no step to be had.
  virtual bool propose(NormalEquations& equations, Eigen::VectorXd& step, double& promised) = 0;
  /// `ratio` is the cost's decrease over the promised one; trust grows or shrinks by it.
  virtual void judge(double ratio) = 0;
};

std::unique_ptr<StepRule> makeStepRule(SolveOptions::Method method, const NormalEquations& equations);

}  // namespace omnimapper::graph
