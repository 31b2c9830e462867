#pragma once

#include <map>
#include <vector>

#include "omnimapper/graph/IncrementalSolver.h"

namespace omnimapper::graph {

/// A pose graph as a robot would have made it: a pose at a time, in the order of ids, with the points that it sees
/// first and every factor to what is there already. Poses are variables "se2" and "se3"; all others count as points.
class PoseByPose {
 public:
  /// `whole` must outlive this object.
  explicit PoseByPose(const Graph& whole);
  std::size_t steps() const { return steps_.size(); }
  /// Adds the next pose, from the estimate of the pose before it where an edge leads from there, otherwise from its
  /// value in the whole graph. Returns the factors that were added, for IncrementalSolver::update().
  std::vector<base::FactorId> grow(const IncrementalSolver& solver);
  /// The graph so far. Its ids are its own.
  const Graph& graph() const { return graph_; }
  Graph& graph() { return graph_; }
  /// The id in graph() of a variable of the whole graph that was added.
  base::VariableId idOf(base::VariableId of_whole) const { return ids_.at(of_whole); }

 private:
  struct Step {
    std::vector<base::VariableId> variables;  // the pose first
    std::vector<base::FactorId> factors;
  };
  Eigen::VectorXd startOf(const Step& step, const IncrementalSolver& solver) const;
  const Graph& whole_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::map<base::VariableId, base::VariableId> ids_;
  Graph graph_;
};

}  // namespace omnimapper::graph
