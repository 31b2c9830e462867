#pragma once

#include <memory>
#include <vector>

#include "omnimapper/graph/GraphChanges.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// How an IncrementalSolver trades accuracy for time.
struct IncrementalOptions {
  /// A variable is linearized anew when its estimate is farther than this from where it was linearized, in any entry of
  /// its tangent [m or rad].
  double relinearize_beyond = 0.02;
  /// Only every so many updates look for such variables.
  int relinearize_every = 1;
  /// Changes of the estimate that are smaller than this in every entry of a tangent [m or rad] are not handed down the
  /// tree.
  double substitute_beyond = 1e-4;
  /// A factor with a robust loss is weighed anew when the weight that its loss gives it changes by more than this part
  /// of it.
  double reweigh_beyond = 0.1;
};

/// What one update did.
struct IncrementalSummary {
  std::size_t eliminated = 0;    ///< variables that were eliminated anew
  std::size_t relinearized = 0;  ///< variables that moved too far from where they were linearized
  double largest_step = 0;       ///< of any entry of a tangent, from where it is linearized [m or rad]
};

/// Follows the minimum of a graph's cost while the graph grows and changes, at a cost that depends on what the change
/// affects and not on the size of the graph. It keeps the Cholesky factor of the Gauss-Newton system as a Bayes tree:
/// a change replaces the top of the tree, from the cliques of its variables to the root, and leaves what hangs below
/// (Kaess et al., iSAM2, IJRR 2012; thesis section 4.1.2). Each clique is a dense block of the factor, with the Schur
/// complement that it hands to its parent.
///
/// The solver keeps copies of the factors; the graph may go, or change, between updates. One thread is used, and the
/// same updates give the same bits.
class IncrementalSolver {
 public:
  explicit IncrementalSolver(const IncrementalOptions& options = {});
  ~IncrementalSolver();
  IncrementalSolver(IncrementalSolver&&) noexcept;
  IncrementalSolver& operator=(IncrementalSolver&&) noexcept;

  /// Takes the changes of the graph into the tree and improves the estimate by one step. A variable that is new starts
  /// from its value in the graph, and so does one that was moved, and one that is fixed or freed, where all its factors
  /// are among `changed`.
  /// Throws Error(internal), before it changes anything, if `added` names a factor that was added already, or `added`
  /// or `changed` one that the graph lacks. Throws Error(internal), naming a variable, if the system is singular
  /// because a part of the graph is not held anywhere; the solver then contains no variable until an update succeeds,
  /// for example one that removes what was added.
  IncrementalSummary update(const Graph& graph, const GraphChanges& changes);
  /// Repeats steps, with every variable linearized anew that moves by more than `tolerance` [m or rad], until none does
  /// or `max_steps` are done. Returns whether none does; false after an update that failed.
  bool converge(double tolerance = 1e-6, int max_steps = 20);

  /// Whether no variable is farther from where it was linearized than relinearize_beyond, and no robust loss gives a
  /// factor another weight than it was linearized with; false after an update that failed.
  bool isSettled() const;

  /// Whether a factor of positive weight binds the variable, and it is not fixed.
  bool contains(base::VariableId id) const;
  /// The estimate, as the graph stores values. Throws Error(internal) if the tree does not contain the variable.
  Eigen::VectorXd value(base::VariableId id) const;
  /// Writes all estimates into the graph, which must have the variables of the tree.
  void store(Graph& graph) const;
  /// Writes the estimates that were computed since the last call of this function, and differ from the graph's values.
  void storeComputed(Graph& graph);
  /// Covariances where the variables are linearized, by the tree as it is now; it shares the eliminated cliques.
  /// `graph` is the one of the last update. Throws Error(internal) after an update that failed.
  Marginals marginals(const Graph& graph) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omnimapper::graph
