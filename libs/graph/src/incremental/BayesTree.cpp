#include "BayesTree.h"

#include <omnimapper/base/Error.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace omnimapper::graph {

void BayesTree::addBound(const std::vector<int>& unknowns, std::vector<int>& all) const {
  std::vector<int> open;
  for (const int unknown : unknowns) {
    if (terms_.unknown(unknown).clique < 0) continue;
    open.push_back(terms_.unknown(unknown).clique);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      all.push_back(node.clique->frontals.front());
      for (const int child : node.children) {
        const auto& separator = clique(child).separator;
        if (std::find(separator.begin(), separator.end(), unknown) != separator.end()) open.push_back(child);
      }
    }
  }
}

std::vector<int> BayesTree::removeTop(const std::vector<int>& unknowns, std::vector<int>& orphans) {
  std::vector<int> affected;
  std::vector<Node> removed;
  for (const int unknown : unknowns) {
    int number = terms_.unknown(unknown).clique;
    if (number < 0) affected.push_back(unknown);
    while (number >= 0 && nodes_[number].clique) {
      removed.push_back(std::move(nodes_[number]));
      nodes_[number] = Node();
      unused_.push_back(number);
      number = removed.back().parent;
    }
  }
  std::sort(affected.begin(), affected.end());
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  for (const Node& node : removed) {
    for (const int child : node.children)
      if (nodes_[child].clique) orphans.push_back(child);
    for (const int unknown : node.clique->frontals) {
      terms_.unknown(unknown).clique = -1;
      affected.push_back(unknown);
    }
  }
  roots_.erase(std::remove_if(roots_.begin(), roots_.end(), [&](int number) { return !nodes_[number].clique; }),
               roots_.end());
  const auto is_unbound = [&](int number) {
    const Unknown& unknown = terms_.unknown(number);
    return unknown.size == 0 || unknown.terms.empty();
  };
  affected.erase(std::remove_if(affected.begin(), affected.end(), is_unbound), affected.end());
  // The same order whatever path led here.
  std::sort(affected.begin(), affected.end());
  return affected;
}

/// The terms that bind unknowns of `affected` alone, and the orphans: what they bind, as places in `affected`. The
/// other terms are in the orphans.
BayesTree::Top BayesTree::gather(std::vector<int> affected, std::vector<int> orphans) {
  Top top{std::move(affected), {}, std::move(orphans), {}};
  place_.resize(static_cast<std::size_t>(terms_.size()), -1);
  for (std::size_t i = 0; i < top.affected.size(); ++i) place_[top.affected[i]] = static_cast<int>(i);
  const auto addSet = [&](const std::vector<int>& bound) {
    top.sets.emplace_back();
    for (const int each : bound) top.sets.back().push_back(place_[each]);
  };
  ++round_;
  for (const int unknown : top.affected)
    for (const int term : terms_.unknown(unknown).terms) {
      if (term >= static_cast<int>(visited_.size())) visited_.resize(static_cast<std::size_t>(term) + 1, 0);
      if (visited_[term] == round_) continue;
      visited_[term] = round_;
      const auto& bound = terms_.term(term).unknowns;
      if (std::any_of(bound.begin(), bound.end(), [&](int each) { return place_[each] < 0; })) continue;
      top.terms.push_back(term);
      addSet(bound);
    }
  for (const int orphan : top.orphans) addSet(clique(orphan).separator);
  return top;
}

/// Makes the cliques of these supernodes, with the orphans below them.
std::vector<BayesTree::Front> BayesTree::build(const Top& top, const std::vector<Supernode>& supernodes,
                                               const std::vector<int>& number_of) {
  std::vector<int> order(top.affected.size()), supernode_of(top.affected.size());
  std::vector<Front> fronts;
  int next = 0;
  for (std::size_t i = 0; i < supernodes.size(); ++i) {
    fronts.push_back({std::make_shared<Clique>(), {}});
    Clique& clique = *fronts.back().clique;
    for (const int node : supernodes[i].frontals) {
      supernode_of[node] = static_cast<int>(i);
      order[node] = next++;
      clique.frontals.push_back(top.affected[node]);
      terms_.unknown(top.affected[node]).clique = number_of[i];
    }
    for (const int node : supernodes[i].separator) clique.separator.push_back(top.affected[node]);
    setOffsets(clique);
    nodes_[number_of[i]].clique = fronts.back().clique;
    if (supernodes[i].parent < 0) {
      roots_.push_back(number_of[i]);
    } else {
      nodes_[number_of[i]].parent = number_of[supernodes[i].parent];
      nodes_[number_of[supernodes[i].parent]].children.push_back(number_of[i]);
    }
  }
  // Each set belongs to the supernode that eliminates the first of its nodes.
  for (std::size_t i = 0; i < top.sets.size(); ++i) {
    const auto& set = top.sets[i];
    const int owner =
        supernode_of[*std::min_element(set.begin(), set.end(), [&](int a, int b) { return order[a] < order[b]; })];
    if (i < top.terms.size()) {
      fronts[owner].terms.push_back(top.terms[i]);
    } else {
      const int orphan = top.orphans[i - top.terms.size()];
      nodes_[orphan].parent = number_of[owner];
      nodes_[number_of[owner]].children.push_back(orphan);
    }
  }
  return fronts;
}

std::size_t BayesTree::replaceTop(const std::vector<int>& unknowns, const std::vector<int>& last) {
  std::vector<int> orphans;
  std::vector<int> affected = removeTop(unknowns, orphans);
  if (affected.empty()) return 0;
  const Top top = gather(std::move(affected), std::move(orphans));
  std::vector<bool> is_last(top.affected.size(), false);
  for (const int unknown : last)
    if (place_[unknown] >= 0) is_last[place_[unknown]] = true;
  for (const int unknown : top.affected) place_[unknown] = -1;
  const auto supernodes = orderElimination(static_cast<int>(top.affected.size()), top.sets, is_last);
  std::vector<int> number_of;
  for (std::size_t i = 0; i < supernodes.size(); ++i) number_of.push_back(newNode());
  const auto fronts = build(top, supernodes, number_of);
  for (std::size_t i = 0; i < fronts.size(); ++i) eliminate(*fronts[i].clique, number_of[i], fronts[i].terms);
  return top.affected.size();
}

int BayesTree::newNode() {
  if (unused_.empty()) {
    nodes_.emplace_back();
    return static_cast<int>(nodes_.size()) - 1;
  }
  const int number = unused_.back();
  unused_.pop_back();
  return number;
}

void BayesTree::setOffsets(Clique& clique) const {
  int row = 0;
  for (const int unknown : clique.frontals) {
    clique.offsets.push_back(row);
    row += terms_.unknown(unknown).size;
  }
  clique.frontal_size = row;
  for (const int unknown : clique.separator) {
    clique.offsets.push_back(row);
    row += terms_.unknown(unknown).size;
  }
  clique.offsets.push_back(row);
}

/// Adds the lower triangle of a block (its unknowns and the gradient) to a front.
void BayesTree::scatter(const std::vector<int>& unknowns, const Eigen::MatrixXd& block, Eigen::MatrixXd& front) {
  const auto last = front.rows() - 1;
  Eigen::Index column = 0;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const int width = terms_.unknown(unknowns[j]).size, to_column = place_[unknowns[j]];
    front.block(to_column, to_column, width, width) += block.block(column, column, width, width);
    Eigen::Index row = column + width;
    for (std::size_t i = j + 1; i < unknowns.size(); ++i) {
      const int height = terms_.unknown(unknowns[i]).size, to_row = place_[unknowns[i]];
      if (to_row > to_column)
        front.block(to_row, to_column, height, width) += block.block(row, column, height, width);
      else
        front.block(to_column, to_row, width, height) += block.block(row, column, height, width).transpose();
      row += height;
    }
    front.block(last, to_column, 1, width) += block.block(row, column, 1, width);
    column += width;
  }
}

void BayesTree::assemble(const Clique& clique, int number, const std::vector<int>& terms, Eigen::MatrixXd& front) {
  front.setZero(clique.offsets.back() + 1, clique.offsets.back() + 1);
  for (std::size_t i = 0; i < clique.frontals.size(); ++i) place_[clique.frontals[i]] = clique.offsets[i];
  for (std::size_t i = 0; i < clique.separator.size(); ++i)
    place_[clique.separator[i]] = clique.offsets[clique.frontals.size() + i];
  for (const int term : terms) {
    const LinearTerm& linear = terms_.linearized(term);
    scatter(linear.unknowns, linear.information, front);
  }
  for (const int child : nodes_[number].children)
    scatter(this->clique(child).separator, this->clique(child).remainder, front);
  for (const int unknown : clique.frontals) place_[unknown] = -1;
  for (const int unknown : clique.separator) place_[unknown] = -1;
}

/// Whether elimination left more of what its factors say of the unknown than rounding explains, in every direction.
bool BayesTree::isDetermined(int number, const Eigen::VectorXd& pivots) const {
  constexpr double kRounding = 1e-13;
  Eigen::VectorXd said = Eigen::VectorXd::Zero(pivots.size());
  for (const int term : terms_.unknown(number).terms) {
    const LinearTerm& linear = terms_.term(term);
    Eigen::Index row = 0;
    for (const int each : linear.unknowns) {
      if (each == number && linear.information.size() > 0)
        said += linear.information.diagonal().segment(row, pivots.size());
      row += terms_.unknown(each).size;
    }
  }
  return pivots.allFinite() && (pivots.array() > 0).all() && (pivots.array().square() > kRounding * said.array()).all();
}

void BayesTree::eliminate(Clique& clique, int number, const std::vector<int>& terms) {
  Eigen::MatrixXd front;
  assemble(clique, number, terms, front);
  const int own = clique.frontal_size;
  const auto rest = front.rows() - own;
  auto diagonal = front.topLeftCorner(own, own);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(diagonal);
  for (std::size_t i = 0; i < clique.frontals.size(); ++i) {
    const auto pivots = front.diagonal().segment(clique.offsets[i], terms_.unknown(clique.frontals[i]).size);
    const bool is_last = i + 1 == clique.frontals.size();
    if (isDetermined(clique.frontals[i], pivots) && (cholesky.info() == Eigen::Success || !is_last)) continue;
    throw base::Error(base::ExitCode::internal,
                      "graph: variable " + toString(terms_.unknown(clique.frontals[i]).id) +
                          " and the variables connected to it are not constrained: fix one of them or add a prior");
  }
  auto below = front.bottomLeftCorner(rest, own);
  diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
  auto remainder = front.bottomRightCorner(rest, rest);
  remainder.selfadjointView<Eigen::Lower>().rankUpdate(below, -1);
  clique.factor = front.leftCols(own);
  clique.remainder = remainder;
}

void BayesTree::clear() {
  for (int i = 0; i < terms_.size(); ++i) terms_.unknown(i).clique = -1;
  nodes_.clear();
  unused_.clear();
  roots_.clear();
}

EliminatedTree BayesTree::eliminated() const {
  EliminatedTree tree;
  tree.nodes.assign(nodes_.begin(), nodes_.end());
  for (int i = 0; i < terms_.size(); ++i) tree.clique_of.push_back(terms_.unknown(i).clique);
  return tree;
}

std::vector<int> BayesTree::unknowns() const {
  std::vector<int> all;
  for (int i = 0; i < terms_.size(); ++i)
    if (terms_.unknown(i).clique >= 0) all.push_back(i);
  return all;
}

}  // namespace omnimapper::graph
