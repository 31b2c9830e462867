#pragma once

#include <memory>
#include <vector>

#include "EliminationOrder.h"
#include "LinearTerms.h"

namespace omnimapper::graph {

/// Unknowns that were eliminated together, given those of the separator, which are eliminated above.
struct Clique {
  std::vector<int> frontals, separator;
  std::vector<int> offsets;  ///< first row of each frontal, then of each of the separator, then that of the gradient
  int frontal_size = 0;      ///< number of rows of the frontals
  /// The columns of the frontals of the Cholesky factor of (information, gradient): rows of frontals, separator and, at
  /// last, of the gradient. Its part above the diagonal is not used.
  Eigen::MatrixXd factor;
  /// What elimination leaves for the separator and the gradient; lower triangle.
  Eigen::MatrixXd remainder;
};

/// A clique that is eliminated, and its place in the tree. Trees that were copied share the cliques.
struct CliqueNode {
  std::shared_ptr<const Clique> clique;  ///< null: the number is not used
  int parent = -1;
};

/// A tree as it was at one time, for covariances.
struct EliminatedTree {
  std::vector<CliqueNode> nodes;
  std::vector<int> clique_of;  ///< for each unknown; -1: it is not in the tree

  /// Columns of L^-1 for the rows of an unknown: for each clique from its own to the root the rows of the frontals.
  struct HalfSolved {
    std::vector<int> cliques;
    std::vector<Eigen::MatrixXd> rows;
  };
  HalfSolved halfSolve(int unknown) const;
  /// Number of rows of an unknown that is in the tree.
  int sizeOf(int unknown) const;
};

/// The Cholesky factor of the linearized terms as a tree of cliques, of which the top can be replaced.
class BayesTree {
 public:
  explicit BayesTree(LinearTerms& terms) : terms_(terms) {}

  /// Unknowns of cliques that have one of these in frontals or separator, for unknowns whose terms are to be linearized
  /// anew.
  void addBound(const std::vector<int>& unknowns, std::vector<int>& all) const;
  /// Eliminates these unknowns anew, and all above them, with those of `last` at the end of the order. Unknowns that
  /// nothing binds any more leave the tree. Returns how many were eliminated. Throws Error(internal), naming a
  /// variable, if the terms do not determine one; the tree is then of no use until clear().
  std::size_t replaceTop(const std::vector<int>& unknowns, const std::vector<int>& last);
  /// Computes the deltas from the root down, as far as they change by more than `beyond`; returns the unknowns that
  /// were computed.
  std::vector<int> substitute(double beyond);
  /// Takes all unknowns out of the tree.
  void clear();
  /// All unknowns in the tree.
  std::vector<int> unknowns() const;
  EliminatedTree eliminated() const;

 private:
  struct Node : CliqueNode {
    std::vector<int> children;
    bool is_new = true;  // it was not substituted back yet
  };
  /// What is eliminated anew.
  struct Top {
    std::vector<int> affected;           // unknowns
    std::vector<int> terms, orphans;     // that bind them; cliques that stay
    std::vector<std::vector<int>> sets;  // what each term, and then each orphan, binds, as places in `affected`
  };
  Top gather(std::vector<int> affected, std::vector<int> orphans);
  /// A clique before it is eliminated, and the terms that it eliminates.
  struct Front {
    std::shared_ptr<Clique> clique;
    std::vector<int> terms;
  };
  std::vector<Front> build(const Top& top, const std::vector<Supernode>& supernodes, const std::vector<int>& number_of);
  std::vector<int> removeTop(const std::vector<int>& unknowns, std::vector<int>& orphans);
  void eliminate(Clique& clique, int number, const std::vector<int>& terms);
  void assemble(const Clique& clique, int number, const std::vector<int>& terms, Eigen::MatrixXd& front);
  void scatter(const std::vector<int>& unknowns, const Eigen::MatrixXd& block, Eigen::MatrixXd& front);
  bool isDetermined(int unknown, const Eigen::VectorXd& pivots) const;
  int newNode();
  void setOffsets(Clique& clique) const;
  const Clique& clique(int number) const { return *nodes_[number].clique; }

  LinearTerms& terms_;
  std::vector<Node> nodes_;
  std::vector<int> unused_;
  std::vector<int> roots_;
  std::vector<int> place_;    // of an unknown among those that are eliminated anew, or of its first row in a front
  std::vector<int> visited_;  // of a term: the round in which it was last taken
  int round_ = 0;
};

}  // namespace omnimapper::graph
