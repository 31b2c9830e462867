#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A decomposed information matrix, from which Marginals computes blocks of its inverse. It may keep what it computes,
/// so that one thread at a time may call its functions.
class MarginalSource {
 public:
  /// A variable in the matrix: a number by which the source knows it, and the size of its tangent.
  struct Place {
    int number;
    int size;
  };

  virtual ~MarginalSource() = default;
  /// None if the matrix does not have the variable.
  virtual std::optional<Place> find(base::VariableId id) const = 0;
  /// Covariance of two variables.
  virtual Eigen::MatrixXd block(Place a, Place b) = 0;
  /// Covariance of each of `others` with `a`.
  virtual std::vector<Eigen::MatrixXd> column(Place a, const std::vector<Place>& others) = 0;
  /// How many numbers it keeps of earlier calls.
  virtual std::size_t kept() const = 0;
  virtual void forget() = 0;
};

/// That of a whole graph at its present values. Throws Error(internal) as Marginals does.
std::unique_ptr<MarginalSource> decomposed(const Graph& graph);

}  // namespace omnimapper::graph
