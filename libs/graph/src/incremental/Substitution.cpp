// What a Bayes tree is asked once it is eliminated: the deltas, from the root down, and columns of L^-1, up to the
// root.
#include <algorithm>

#include "BayesTree.h"

namespace omnimapper::graph {

std::vector<int> BayesTree::substitute(double beyond) {
  std::vector<int> computed, open = roots_;
  std::vector<bool> changed(static_cast<std::size_t>(terms_.size()), false);
  Eigen::VectorXd right;
  while (!open.empty()) {
    Node& node = nodes_[open.back()];
    const Clique& clique = *node.clique;
    open.pop_back();
    const bool is_reached =
        std::any_of(clique.separator.begin(), clique.separator.end(), [&](int unknown) { return changed[unknown]; });
    // What is new hangs below nothing that is old.
    if (!is_reached && !node.is_new) continue;
    const auto size = clique.factor.rows() - 1;
    right = -clique.factor.row(size).transpose();
    for (std::size_t i = 0; i < clique.separator.size(); ++i) {
      const Unknown& unknown = terms_.unknown(clique.separator[i]);
      right.noalias() -=
          clique.factor.middleRows(clique.offsets[clique.frontals.size() + i], unknown.size).transpose() *
          unknown.delta;
    }
    clique.factor.topRows(clique.frontal_size).triangularView<Eigen::Lower>().transpose().solveInPlace(right);
    for (std::size_t i = 0; i < clique.frontals.size(); ++i) {
      Unknown& unknown = terms_.unknown(clique.frontals[i]);
      const auto delta = right.segment(clique.offsets[i], unknown.size);
      computed.push_back(clique.frontals[i]);
      // Small changes add up until they are handed down.
      if ((delta - unknown.delta).lpNorm<Eigen::Infinity>() <= beyond) continue;
      changed[clique.frontals[i]] = true;
      unknown.delta = delta;
    }
    node.is_new = false;
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
  return computed;
}

int EliminatedTree::sizeOf(int unknown) const {
  const Clique& clique = *nodes[clique_of[unknown]].clique;
  const auto at = std::find(clique.frontals.begin(), clique.frontals.end(), unknown) - clique.frontals.begin();
  return clique.offsets[at + 1] - clique.offsets[at];
}

EliminatedTree::HalfSolved EliminatedTree::halfSolve(int number) const {
  const int size = sizeOf(number);
  HalfSolved solved;
  // What is left for the unknowns above, by their numbers.
  std::unordered_map<int, Eigen::MatrixXd> right;
  right[number] = Eigen::MatrixXd::Identity(size, size);
  for (int at = clique_of[number]; at >= 0; at = nodes[at].parent) {
    const Clique& clique = *nodes[at].clique;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(clique.frontal_size, size);
    for (std::size_t i = 0; i < clique.frontals.size(); ++i) {
      const auto found = right.find(clique.frontals[i]);
      if (found != right.end()) rows.middleRows(clique.offsets[i], found->second.rows()) = found->second;
    }
    clique.factor.topRows(clique.frontal_size).triangularView<Eigen::Lower>().solveInPlace(rows);
    for (std::size_t i = 0; i < clique.separator.size(); ++i) {
      const int first = clique.offsets[clique.frontals.size() + i],
                height = clique.offsets[clique.frontals.size() + i + 1] - first;
      Eigen::MatrixXd& left = right[clique.separator[i]];
      if (left.size() == 0) left = Eigen::MatrixXd::Zero(height, size);
      left.noalias() -= clique.factor.middleRows(first, height) * rows;
    }
    solved.cliques.push_back(at);
    solved.rows.push_back(std::move(rows));
  }
  return solved;
}

}  // namespace omnimapper::graph
