#pragma once

#include <memory>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

class MarginalSource;

/// Marginal covariances of the variables of a graph at its present values. They are blocks of the inverse of the
/// information matrix, in the variables' tangents, with weights and losses as the solver applies them. The constructor
/// decomposes the matrix; after that, the object does not see changes of the graph. For a block, a part of the
/// decomposed matrix is used instead of computing the whole inverse, and recent blocks are cached. Blocks of fixed
/// variables are zero.
class Marginals {
 public:
  /// Throws Error(internal) if a connected part of the graph is not held anywhere (see solve()), or if no factor
  /// determines some direction of a variable.
  explicit Marginals(const Graph& graph);
  /// By a matrix that is decomposed already, of this graph. IncrementalSolver::marginals() has one.
  Marginals(const Graph& graph, std::unique_ptr<MarginalSource> source);
  ~Marginals();
  Marginals(Marginals&&) noexcept;
  Marginals& operator=(Marginals&&) noexcept;

  /// Whether the variable is fixed or bound by a factor of positive weight, as the functions below require.
  bool contains(base::VariableId id) const;
  /// [tangentSize x tangentSize]. Throws Error(internal) if no factor of positive weight binds the variable.
  Eigen::MatrixXd covariance(base::VariableId id) const;
  /// Joint covariance of several variables; the blocks are in the order of `ids`, which may contain an id twice. Throws
  /// as covariance() does. Several threads may call this function at once.
  Eigen::MatrixXd jointCovariance(const std::vector<base::VariableId>& ids) const;
  /// Covariance of each of `others` with `id`: block i is [tangentSize of others[i] x tangentSize of id].
  std::vector<Eigen::MatrixXd> crossCovariances(base::VariableId id, const std::vector<base::VariableId>& others) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace omnimapper::graph
