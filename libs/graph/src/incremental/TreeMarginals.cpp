#include "TreeMarginals.h"

#include <algorithm>

namespace omnimapper::graph {

std::optional<MarginalSource::Place> TreeMarginals::find(base::VariableId id) const {
  const auto found = number_of_.find(id);
  if (found == number_of_.end() || tree_.clique_of[found->second] < 0) return std::nullopt;
  return Place{found->second, tree_.sizeOf(found->second)};
}

const EliminatedTree::HalfSolved& TreeMarginals::halves(int unknown) {
  const auto [place, is_new] = halves_.try_emplace(unknown);
  if (is_new) {
    place->second = tree_.halfSolve(unknown);
    for (const auto& rows : place->second.rows) kept_ += static_cast<std::size_t>(rows.size()) + 4;
  }
  return place->second;
}

Eigen::MatrixXd TreeMarginals::block(Place a, Place b) {
  const auto& left = halves(a.number);
  const auto& right = halves(b.number);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(a.size, b.size);
  // Both paths end at the root: what they share is at their ends.
  for (auto i = left.cliques.size(), j = right.cliques.size();
       i > 0 && j > 0 && left.cliques[i - 1] == right.cliques[j - 1]; --i, --j)
    block.noalias() += left.rows[i - 1].transpose() * right.rows[j - 1];
  return block;
}

/// From the root down, along the paths to the others.
std::vector<Eigen::MatrixXd> TreeMarginals::column(Place a, const std::vector<Place>& others) {
  const auto& half = halves(a.number);
  std::unordered_map<int, const Eigen::MatrixXd*> right;  // of the cliques on the path of `a`
  for (std::size_t i = 0; i < half.cliques.size(); ++i) right[half.cliques[i]] = &half.rows[i];
  std::unordered_map<int, Eigen::MatrixXd> solved;  // of unknowns
  std::vector<bool> is_solved(tree_.nodes.size(), false);
  std::vector<Eigen::MatrixXd> blocks;
  std::vector<int> path;
  for (const Place other : others) {
    path.clear();
    for (int at = tree_.clique_of[other.number]; at >= 0 && !is_solved[at]; at = tree_.nodes[at].parent)
      path.push_back(at);
    for (auto at = path.rbegin(); at != path.rend(); ++at) {
      const Clique& clique = *tree_.nodes[*at].clique;
      const auto on_path = right.find(*at);
      Eigen::MatrixXd rows = on_path == right.end() ? Eigen::MatrixXd::Zero(clique.frontal_size, a.size)
                                                    : Eigen::MatrixXd(*on_path->second);
      const auto count = clique.frontals.size();
      for (std::size_t i = 0; i < clique.separator.size(); ++i) {
        const Eigen::MatrixXd& above = solved.at(clique.separator[i]);
        rows.noalias() -= clique.factor.middleRows(clique.offsets[count + i], above.rows()).transpose() * above;
      }
      clique.factor.topRows(clique.frontal_size).triangularView<Eigen::Lower>().transpose().solveInPlace(rows);
      for (std::size_t i = 0; i < count; ++i)
        solved[clique.frontals[i]] = rows.middleRows(clique.offsets[i], clique.offsets[i + 1] - clique.offsets[i]);
      is_solved[*at] = true;
    }
    blocks.push_back(solved.at(other.number));
  }
  return blocks;
}

void TreeMarginals::forget() {
  halves_.clear();
  kept_ = 0;
}

}  // namespace omnimapper::graph
