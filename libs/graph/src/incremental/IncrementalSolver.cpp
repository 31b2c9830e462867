#include "omnimapper/graph/IncrementalSolver.h"

#include <omnimapper/base/Error.h>

#include <algorithm>

#include "../SingleThreadedBlas.h"
#include "BayesTree.h"

namespace omnimapper::graph {

struct IncrementalSolver::State {
  explicit State(const IncrementalOptions& given) : options(given) {}

  /// Unknowns among these that are farther than `beyond` from where they are linearized.
  std::vector<int> moved(const std::vector<int>& among, double beyond) const {
    std::vector<int> far;
    for (const int number : among)
      if (terms.unknown(number).clique >= 0 && terms.unknown(number).delta.lpNorm<Eigen::Infinity>() > beyond)
        far.push_back(number);
    return far;
  }
  /// Linearizes these anew, eliminates them and `touched`, and computes the estimate.
  IncrementalSummary step(std::vector<int> touched, const std::vector<int>& far, double substitute_beyond) {
    IncrementalSummary summary;
    const std::vector<int> last = touched;
    tree.addBound(far, touched);
    for (const int number : far) terms.relinearize(number);
    try {
      summary.eliminated = tree.replaceTop(is_cleared ? terms.bound() : touched, last);
      is_cleared = false;
    } catch (const base::Error&) {
      tree.clear();
      is_cleared = true;
      throw;
    }
    summary.relinearized = far.size();
    const auto computed = tree.substitute(substitute_beyond);
    for (const int number : computed)
      summary.largest_step = std::max(summary.largest_step, terms.unknown(number).delta.lpNorm<Eigen::Infinity>());
    unlooked.insert(unlooked.end(), computed.begin(), computed.end());
    return summary;
  }
  int numberInTree(base::VariableId id) const {
    const int number = terms.numberOf(id);
    if (number < 0 || terms.unknown(number).clique < 0)
      throw base::Error(base::ExitCode::internal,
                        "incremental solver: variable " + toString(id) + " is not in the tree");
    return number;
  }
  void checkKnown(const Graph& graph, const GraphChanges& changes) const;

  IncrementalOptions options;
  LinearTerms terms;
  BayesTree tree{terms};
  std::vector<int> unlooked;  // unknowns whose deltas were computed since an update looked how far they are
  bool is_cleared = false;    // an update failed: the next one eliminates all unknowns
  int updates = 0;
};

/// Before anything is changed.
void IncrementalSolver::State::checkKnown(const Graph& graph, const GraphChanges& changes) const {
  const auto fail = [](base::FactorId id, const char* why) {
    throw base::Error(base::ExitCode::internal, "incremental solver: factor " + toString(id) + why);
  };
  for (const auto id : changes.added) {
    if (terms.has(id)) fail(id, " is in the tree already");
    if (!graph.contains(id)) fail(id, " is not in the graph");
  }
  for (const auto id : changes.changed)
    if (!graph.contains(id)) fail(id, " is not in the graph");
}

IncrementalSolver::IncrementalSolver(const IncrementalOptions& options) : state_(std::make_unique<State>(options)) {}
IncrementalSolver::~IncrementalSolver() = default;
IncrementalSolver::IncrementalSolver(IncrementalSolver&&) noexcept = default;
IncrementalSolver& IncrementalSolver::operator=(IncrementalSolver&&) noexcept = default;

IncrementalSummary IncrementalSolver::update(const Graph& graph, const GraphChanges& changes) {
  const SingleThreadedBlas one_thread;
  State& state = *state_;
  state.checkKnown(graph, changes);
  std::vector<int> touched;
  const auto touch = [&](const std::vector<int>& unknowns) {
    touched.insert(touched.end(), unknowns.begin(), unknowns.end());
  };
  // A factor of weight 0 is not in the tree.
  for (const auto id : changes.removed)
    if (state.terms.has(id)) touch(state.terms.remove(id));
  for (const auto id : changes.changed)
    if (state.terms.has(id)) touch(state.terms.remove(id));
  for (const auto* list : {&changes.added, &changes.changed})
    for (const auto id : *list) {
      const int number = state.terms.add(graph, id);
      if (number >= 0) touch(state.terms.term(number).unknowns);
    }
  std::vector<int> far;
  if (++state.updates % std::max(state.options.relinearize_every, 1) == 0) {
    auto& unlooked = state.unlooked;
    std::sort(unlooked.begin(), unlooked.end());
    unlooked.erase(std::unique(unlooked.begin(), unlooked.end()), unlooked.end());
    far = state.moved(unlooked, state.options.relinearize_beyond);
    unlooked.clear();
  }
  return state.step(std::move(touched), far, state.options.substitute_beyond);
}

bool IncrementalSolver::converge(double tolerance, int max_steps) {
  const SingleThreadedBlas one_thread;
  State& state = *state_;
  if (state.is_cleared) return false;
  for (int i = 0; i < max_steps; ++i) {
    const auto far = state.moved(state.tree.unknowns(), tolerance);
    if (far.empty()) return true;
    state.step({}, far, 0);
  }
  return state.moved(state.tree.unknowns(), tolerance).empty();
}

bool IncrementalSolver::contains(base::VariableId id) const {
  const int number = state_->terms.numberOf(id);
  return number >= 0 && state_->terms.unknown(number).clique >= 0;
}

Eigen::VectorXd IncrementalSolver::value(base::VariableId id) const {
  return state_->terms.estimate(state_->numberInTree(id));
}

void IncrementalSolver::store(Graph& graph) const {
  for (const int number : state_->tree.unknowns())
    graph.setValue(state_->terms.unknown(number).id, state_->terms.estimate(number));
}

Eigen::MatrixXd IncrementalSolver::jointCovariance(const std::vector<base::VariableId>& ids) const {
  const SingleThreadedBlas one_thread;
  std::vector<BayesTree::HalfSolved> halves;
  std::vector<int> offsets{0};
  for (const auto id : ids) {
    const int number = state_->numberInTree(id);
    halves.push_back(state_->tree.halfSolve(number));
    offsets.push_back(offsets.back() + state_->terms.unknown(number).size);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(offsets.back(), offsets.back());
  for (std::size_t i = 0; i < halves.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      auto block = covariance.block(offsets[i], offsets[j], offsets[i + 1] - offsets[i], offsets[j + 1] - offsets[j]);
      // Both paths end at the root: what they share is at their ends.
      auto a = halves[i].cliques.size(), b = halves[j].cliques.size();
      while (a > 0 && b > 0 && halves[i].cliques[a - 1] == halves[j].cliques[b - 1]) {
        --a;
        --b;
        block.noalias() += halves[i].rows[a].transpose() * halves[j].rows[b];
      }
      if (j < i) covariance.block(offsets[j], offsets[i], block.cols(), block.rows()) = block.transpose();
    }
  return covariance;
}

}  // namespace omnimapper::graph
