#pragma once

#include <unordered_map>
#include <vector>

#include "BoundFactor.h"
#include "SparseCholesky.h"

namespace omnimapper::graph {

/// The Gauss-Newton approximation of the graph's cost: information * step = -gradient, in the stacked tangents of the
/// free variables. Each factor counts by its weight times the derivative of its loss. Fixed variables, and those that
/// no factor of positive weight binds, are not among the unknowns. It refers to the graph, and must be built anew when
/// factors are added or removed.
class NormalEquations {
 public:
  explicit NormalEquations(const Graph& graph);

  /// Fills information and gradient at the given ambient values; returns the cost.
  double linearize(const Eigen::VectorXd& values);
  /// Returns only the cost.
  double cost(const Eigen::VectorXd& values) const;
  /// Sets `moved` to values plus step, variable by variable.
  void plus(const Eigen::VectorXd& values, const Eigen::VectorXd& step, Eigen::VectorXd& moved) const;

  /// The graph's values in one stacked vector, which the other methods take.
  Eigen::VectorXd values(const Graph& graph) const;
  void store(const Eigen::VectorXd& values, Graph& graph) const;

  const SymmetricMatrix& information() const { return information_; }
  SymmetricMatrix& information() { return information_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// Tangent sizes of the free variables, in order.
  const std::vector<int>& groups() const { return groups_; }
  /// Indices of the diagonal in `information().values`.
  const std::vector<int>& diagonal() const { return diagonal_; }
  /// First row of a variable's tangent, or -1 if it is not among the unknowns.
  int offset(base::VariableId id) const;
  /// Whether a factor of positive weight binds the variable, fixed or not.
  bool contains(base::VariableId id) const { return place_of_.count(id) > 0; }

 private:
  struct Place {
    base::VariableId id;
    const Variable* kind;
    int value_offset;
    int tangent_offset;  // -1 for a fixed one
    int group;           // of the free variables, -1 for a fixed one
  };
  struct Block {
    int first = -1;        // index of the block's first entry in information_.values; -1 if there is no block
    int stride = 0;        // from one column of it to the next
    bool swapped = false;  // the later slot of the pair is the column
  };
  struct Term {
    BoundFactor factor;
    std::vector<int> places;    // indices in places_, one for each slot
    std::vector<Block> blocks;  // of the pairs of slots (i, j), j <= i: at i (i + 1) / 2 + j
  };
  /// For each group, the groups at or after it that share a factor with it, ascending, and their first row in a column.
  struct ColumnPattern {
    std::vector<int> groups;
    std::vector<int> first_rows;
  };
  void addPlaces(const Graph& graph);
  void addTerms(const Graph& graph);
  std::vector<ColumnPattern> columnPatterns() const;
  void buildMatrix(const std::vector<ColumnPattern>& patterns);
  void bindBlocks(const std::vector<ColumnPattern>& patterns);
  void accumulate(const Term& term, double weight, const double* residual, const double* const* jacobians);

  std::vector<Place> places_;
  std::unordered_map<base::VariableId, int> place_of_;
  std::vector<Term> terms_;
  std::vector<int> groups_;         // tangent sizes
  std::vector<int> group_offsets_;  // first rows
  std::vector<int> diagonal_;
  int value_size_ = 0;
  SymmetricMatrix information_;
  Eigen::VectorXd gradient_;
};

}  // namespace omnimapper::graph
