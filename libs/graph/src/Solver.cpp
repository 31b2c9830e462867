#include "omnimapper/graph/Solver.h"

#include <cmath>

#include "GaugeCheck.h"
#include "NormalEquations.h"
#include "SingleThreadedBlas.h"
#include "StepRule.h"

namespace omnimapper::graph {

namespace {

/// Takes steps from the graph's values until one of the reasons to end applies; `values_` are the best so far.
class Descent {
 public:
  Descent(const Graph& graph, const SolveOptions& options)
      : options_(options), equations_(graph), values_(equations_.values(graph)), cost_(equations_.linearize(values_)) {
    summary_.initial_cost = cost_;
  }

  SolveSummary run() {
    if (equations_.information().size == 0) {
      end(true, "nothing to solve: every variable is fixed or bound by no factor");
    } else {
      rule_ = makeStepRule(options_.method, equations_);
      while (!ended_) iterate();
    }
    summary_.final_cost = cost_;
    return summary_;
  }
  void store(Graph& graph) const { equations_.store(values_, graph); }

 private:
  void iterate() {
    if (cost_ == 0 || equations_.gradient().lpNorm<Eigen::Infinity>() < kGradientTolerance)
      return end(true, "the gradient is zero");
    if (summary_.iterations >= options_.max_iterations)
      return end(false, "the largest number of iterations is reached");
    double predicted = 0;
    if (!rule_->propose(equations_, step_, predicted))
      return end(false, "the normal equations have no finite solution");
    ++summary_.iterations;
    equations_.plus(values_, step_, moved_);
    const double new_cost = equations_.cost(moved_);
    const double decrease = cost_ - new_cost;
    const double ratio = std::isfinite(new_cost) && predicted > 0 ? decrease / predicted : -1;
    rule_->judge(ratio);
    if (ratio > 0) {
      values_.swap(moved_);
      const double before = cost_;
      cost_ = equations_.linearize(values_);
      rule_->moved();
      if (decrease <= options_.function_tolerance * before) return end(true, "the cost no longer falls");
    } else if (predicted <= options_.function_tolerance * cost_) {
      return end(true, "the cost can no longer fall");
    }
    if (options_.stop && options_.stop()) end(false, "stopped on request");
  }

  void end(bool converged, const char* reason) {
    ended_ = true;
    summary_.converged = converged;
    summary_.reason = reason;
  }

  static constexpr double kGradientTolerance = 1e-12;
  const SolveOptions& options_;
  NormalEquations equations_;
  std::unique_ptr<StepRule> rule_;
  Eigen::VectorXd values_, step_, moved_;
  double cost_;
  bool ended_ = false;
  SolveSummary summary_;
};

}  // namespace

SolveSummary solve(Graph& graph, const SolveOptions& options) {
  checkGauge(graph);
  const SingleThreadedBlas one_thread;
  Descent descent(graph, options);
  const SolveSummary summary = descent.run();
  descent.store(graph);
  return summary;
}

}  // namespace omnimapper::graph
