#include "omnimapper/graph/IncrementalSolver.h"

#include <omnimapper/base/Error.h>

#include <algorithm>

#include "../SingleThreadedBlas.h"
#include "BayesTree.h"
#include "TreeMarginals.h"

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
  /// The unknowns whose deltas were computed since an update looked how far they are.
  const std::vector<int>& toLookAt() {
    std::sort(unlooked.begin(), unlooked.end());
    unlooked.erase(std::unique(unlooked.begin(), unlooked.end()), unlooked.end());
    return unlooked;
  }
  /// Terms of these unknowns whose robust loss gives them another weight at the estimate.
  std::vector<int> wronglyWeighed(const std::vector<int>& among, double beyond) const {
    std::vector<int> found;
    for (const int number : among)
      for (const int term : terms.unknown(number).terms)
        if (terms.isWeighedWrongly(term, beyond)) found.push_back(term);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  /// Eliminates `touched`, and those whose terms bind `relinearized`, and computes the estimate.
  IncrementalSummary step(std::vector<int> touched, const std::vector<int>& relinearized, double substitute_beyond) {
    IncrementalSummary summary;
    const std::vector<int> last = touched;
    tree.addBound(relinearized, touched);
    try {
      summary.eliminated = tree.replaceTop(is_cleared ? terms.bound() : touched, last);
      is_cleared = false;
    } catch (const base::Error&) {
      tree.clear();
      is_cleared = true;
      throw;
    }
    summary.relinearized = relinearized.size();
    const auto computed = tree.substitute(substitute_beyond);
    for (const int number : computed)
      summary.largest_step = std::max(summary.largest_step, terms.unknown(number).delta.lpNorm<Eigen::Infinity>());
    unlooked.insert(unlooked.end(), computed.begin(), computed.end());
    unstored.insert(unstored.end(), computed.begin(), computed.end());
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
  std::vector<int> unstored;  // unknowns whose deltas were computed since they were stored
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
  std::vector<int> relinearized;
  for (const auto id : changes.moved) {
    const int number = state.terms.numberOf(id);
    if (number < 0 || state.terms.unknown(number).size == 0) continue;
    state.terms.place(number, graph.value(id));
    if (state.terms.unknown(number).clique >= 0) relinearized.push_back(number);
  }
  if (++state.updates % std::max(state.options.relinearize_every, 1) == 0) {
    const auto looked_at = state.toLookAt();
    for (const int term : state.wronglyWeighed(looked_at, state.options.reweigh_beyond)) {
      touch(state.terms.term(term).unknowns);
      state.terms.weighAnew(term);
    }
    for (const int number : state.moved(looked_at, state.options.relinearize_beyond)) {
      state.terms.relinearize(number);
      relinearized.push_back(number);
    }
    state.unlooked.clear();
  }
  return state.step(std::move(touched), relinearized, state.options.substitute_beyond);
}

bool IncrementalSolver::isSettled() const {
  if (state_->is_cleared) return false;
  const auto& among = state_->toLookAt();
  return state_->moved(among, state_->options.relinearize_beyond).empty() &&
         state_->wronglyWeighed(among, state_->options.reweigh_beyond).empty();
}

bool IncrementalSolver::converge(double tolerance, int max_steps) {
  const SingleThreadedBlas one_thread;
  State& state = *state_;
  if (state.is_cleared) return false;
  for (int i = 0;; ++i) {
    const auto all = state.tree.unknowns();
    const auto far = state.moved(all, tolerance);
    const auto wrong = state.wronglyWeighed(all, tolerance);
    if (far.empty() && wrong.empty()) return true;
    if (i == max_steps) return false;
    std::vector<int> touched;
    for (const int term : wrong) {
      const auto& bound = state.terms.term(term).unknowns;
      touched.insert(touched.end(), bound.begin(), bound.end());
      state.terms.weighAnew(term);
    }
    for (const int number : far) state.terms.relinearize(number);
    state.step(std::move(touched), far, 0);
  }
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

void IncrementalSolver::storeComputed(Graph& graph) {
  auto& unstored = state_->unstored;
  std::sort(unstored.begin(), unstored.end());
  unstored.erase(std::unique(unstored.begin(), unstored.end()), unstored.end());
  for (const int number : unstored) {
    const Unknown& unknown = state_->terms.unknown(number);
    if (unknown.clique < 0) continue;
    const Eigen::VectorXd value = state_->terms.estimate(number);
    if (value != graph.value(unknown.id)) graph.setValue(unknown.id, value);
  }
  unstored.clear();
}

Marginals IncrementalSolver::marginals(const Graph& graph) const {
  if (state_->is_cleared)
    throw base::Error(base::ExitCode::internal,
                      "incremental solver: the last update failed, so there are no covariances");
  return Marginals(graph, std::make_unique<TreeMarginals>(state_->tree.eliminated(), state_->terms.numbers()));
}

}  // namespace omnimapper::graph
