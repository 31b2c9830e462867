#pragma once

#include <memory>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// How well the variables of a graph are known at its present values: blocks of the inverse of the information matrix,
/// in the variables' tangents, with weights and losses as the solver counts them. Made at once, then independent of the
/// graph. A block costs a path through the factored matrix, not the whole inverse, and next to nothing when it was
/// asked for lately. Fixed variables have zeros.
class Marginals {
 public:
  /// Throws Error(internal) if a part of the graph hangs free (see solve()), or if a direction of some variable is
  /// determined by nothing.
  explicit Marginals(const Graph& graph);
  ~Marginals();
  Marginals(Marginals&&) noexcept;
  Marginals& operator=(Marginals&&) noexcept;

  /// Whether it is fixed, or bound by a factor of positive weight: what the functions below can answer for.
  bool contains(base::VariableId id) const;
  /// [tangentSize x tangentSize]. Throws Error(internal) if no factor of positive weight binds the variable.
  Eigen::MatrixXd covariance(base::VariableId id) const;
  /// Of several variables together, blocks in the order of `ids`. Throws as covariance(). An id may stand there twice.
  /// Several threads may ask at once.
  Eigen::MatrixXd jointCovariance(const std::vector<base::VariableId>& ids) const;
  /// Covariance of each of `others` with `id`: block i is [tangentSize of others[i] x tangentSize of id].
  std::vector<Eigen::MatrixXd> crossCovariances(base::VariableId id, const std::vector<base::VariableId>& others) const;

 private:
  struct State;
  class Blocks;
  std::unique_ptr<State> state_;
  std::unique_ptr<Blocks> blocks_;
};

}  // namespace omnimapper::graph
