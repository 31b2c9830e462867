#pragma once

#include "../MarginalSource.h"
#include "BayesTree.h"

namespace omnimapper::graph {

/// Covariances by a tree that is eliminated already; a place is the number of an unknown. Keeps the half-solved
/// columns.
class TreeMarginals : public MarginalSource {
 public:
  /// `number_of`: of each variable in the terms of the tree.
  TreeMarginals(EliminatedTree tree, std::unordered_map<base::VariableId, int> number_of)
      : tree_(std::move(tree)), number_of_(std::move(number_of)) {}

  std::optional<Place> find(base::VariableId id) const override;
  Eigen::MatrixXd block(Place a, Place b) override;
  std::vector<Eigen::MatrixXd> column(Place a, const std::vector<Place>& others) override;
  std::size_t kept() const override { return kept_; }
  void forget() override;

 private:
  const EliminatedTree::HalfSolved& halves(int unknown);

  EliminatedTree tree_;
  std::unordered_map<base::VariableId, int> number_of_;
  std::unordered_map<int, EliminatedTree::HalfSolved> halves_;
  std::size_t kept_ = 0;
};

}  // namespace omnimapper::graph
