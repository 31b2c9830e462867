#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "../BoundFactor.h"

namespace omnimapper::graph {

/// A variable of an incremental solver. `size` is 0 for one that is fixed.
struct Unknown {
  base::VariableId id;
  std::shared_ptr<const Variable> kind;
  int size = 0;
  Eigen::VectorXd linearized;  ///< where its factors are linearized [ambientSize]
  Eigen::VectorXd delta;       ///< the estimate is linearized plus delta [size]
  std::vector<int> terms;      ///< those that bind it
  int clique = -1;             ///< of the tree in which it is eliminated; -1: not yet
};

/// A factor of positive weight, linearized: 1/2 x^T information x with x = (deltas of its free unknowns, 1), so that
/// the last column is the gradient. A robust loss has the weight that it gives at the estimate (iteratively reweighted
/// least squares).
struct LinearTerm {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::unique_ptr<FactorRecord> record;
  std::optional<BoundFactor> factor;  ///< of the record
  std::vector<int> slots;             ///< the unknown of each slot
  std::vector<int> unknowns;          ///< those of them that are free
  Eigen::MatrixXd information;        ///< empty until it is needed
  RowMatrix rows;                     ///< with a robust loss: the whitened residual is rows x
  double loss = 1;                    ///< the weight that the loss gives it
};

/// The variables and factors that an incremental solver knows, addressed by numbers that stay.
class LinearTerms {
 public:
  /// Adds a factor of the graph and the variables that are new. Returns the number of the term; -1 if its weight is 0.
  int add(const Graph& graph, base::FactorId id);
  /// Returns the unknowns that it bound. They stay, also where nothing binds them any more.
  std::vector<int> remove(base::FactorId id);
  bool has(base::FactorId id) const { return term_of_.count(id) > 0; }

  const LinearTerm& term(int number) const { return terms_[number]; }
  /// The term, linearized where its unknowns are.
  const LinearTerm& linearized(int number);
  const Unknown& unknown(int number) const { return unknowns_[number]; }
  Unknown& unknown(int number) { return unknowns_[number]; }
  int size() const { return static_cast<int>(unknowns_.size()); }
  /// The number of a variable; -1 if it is not known.
  int numberOf(base::VariableId id) const;
  const std::unordered_map<base::VariableId, int>& numbers() const { return number_of_; }
  /// The free unknowns that a term binds.
  std::vector<int> bound() const;
  /// Moves an unknown to its estimate, where its terms are to be linearized anew.
  void relinearize(int number);
  /// Moves an unknown to a value, where its terms are to be linearized anew.
  void place(int number, const Eigen::VectorXd& value);
  Eigen::VectorXd estimate(int number) const;
  /// Whether the estimate changes the weight that a robust loss gives a linearized term by more than a part of it.
  bool isWeighedWrongly(int term, double beyond) const;
  void weighAnew(int term) { terms_[term].information.resize(0, 0); }

 private:
  double lossAt(const LinearTerm& term, const LinearTerm::RowMatrix& rows) const;
  int unknownOf(const Graph& graph, base::VariableId id);
  std::vector<Unknown> unknowns_;
  std::vector<LinearTerm> terms_;
  std::vector<int> unused_terms_;
  std::unordered_map<base::VariableId, int> number_of_;
  std::unordered_map<base::FactorId, int> term_of_;
};

}  // namespace omnimapper::graph
