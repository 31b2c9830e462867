#include "omnimapper/graph/Consistency.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <map>
#include <utility>

#include "EasedSolve.h"
#include "HypothesisRevision.h"
#include "Selection.h"
#include "UnconstrainedVariables.h"
#include "omnimapper/graph/PointFactor.h"

namespace omnimapper::graph {

namespace {

using base::FactorId;
using Method = ConsistencyOptions::Method;

/// Number of the newest refused hypotheses that are tested again together with fresh ones.
constexpr std::size_t kMostWaiting = 20;
/// Largest number of fresh hypotheses that are judged together; more are judged as if they had come one after another.
constexpr std::size_t kMostAtOnce = 20;

bool contains(const std::vector<FactorId>& some, FactorId id) {
  return std::find(some.begin(), some.end(), id) != some.end();
}

/// One run of the test.
class Test {
 public:
  Test(Graph& graph, const std::vector<FactorId>& fresh, const ConsistencyOptions& options,
       const SolveOptions& solve_options, Minimizer& minimizer)
      : graph_(graph),
        fresh_(fresh),
        options_(options),
        solve_options_(solve_options),
        minimizer_(minimizer),
        gate_(options) {
    for (const FactorId id : fresh_)
      if (!graph_.factor(id).tags.hypothesis)
        throw base::Error(base::ExitCode::internal,
                          "consistency test: factor " + toString(id) + " is not a hypothesis");
    for (const auto& [id, record] : graph_.factors())
      if (record.tags.hypothesis) acted_[id] = record.weight > 0;
  }

  std::vector<HypothesisVerdict> run() {
    if (options_.method == Method::none) {
      for (const FactorId id : fresh_) decide(id, true, misfit(id), "accepted without a test");
      solveEased(graph_, fresh_, solve_options_, minimizer_);
      return verdicts();
    }
    later_ = inOrderOfTime();
    for (const FactorId id : later_) graph_.setWeight(id, 0);
    do {
      const std::size_t size = std::min(later_.size(), kMostAtOnce);
      const std::vector<FactorId> some(later_.begin(), later_.begin() + static_cast<std::ptrdiff_t>(size));
      later_.erase(later_.begin(), later_.begin() + static_cast<std::ptrdiff_t>(size));
      judge(some);
    } while (!later_.empty());
    return verdicts();
  }

 private:
  int rowsOf(FactorId id) const { return graph_.factor(id).factor->residualSize(); }
  double bound(FactorId id) const { return gate_.bound(rowsOf(id)); }
  double misfit(FactorId id) const { return graph_.whitenedResidual(id).squaredNorm(); }

  void decide(FactorId id, bool accepted, double chi2, const std::string& reason,
              std::optional<FactorId> against = std::nullopt) {
    graph_.setWeight(id, accepted ? 1 : 0);
    verdicts_[id] = {id, accepted, accepted != acted_.at(id), chi2, bound(id), rowsOf(id), reason, against};
  }

  /// The fresh hypotheses in the order in which they could have come: by the newest of their variables.
  std::vector<FactorId> inOrderOfTime() const {
    const auto newest = [this](FactorId id) {
      const std::vector<base::VariableId>& variables = graph_.factor(id).variables;
      return *std::max_element(variables.begin(), variables.end());
    };
    std::vector<FactorId> order = fresh_;
    std::stable_sort(order.begin(), order.end(), [&](FactorId a, FactorId b) { return newest(a) < newest(b); });
    return order;
  }

  void judge(const std::vector<FactorId>& some) {
    const std::vector<FactorId> acting_before = acting();
    const std::vector<FactorId> contradicting = take(some);
    solveWithoutLosses(acting_before);
    solveEased(graph_, newOf(acting_before), solve_options_, minimizer_);
    if (!contradicting.empty()) reviseBy(contradicting);
    confirmByOthers(some);
    takeBackWhatNoLongerFits();
    acceptWhatFitsNow();
  }

  /// The newest hypotheses that do not act and were judged before these, in the order of ids.
  template <class Wanted>
  std::vector<FactorId> waiting(const std::vector<FactorId>& some, const Wanted& isWanted) const {
    std::vector<FactorId> found;
    for (auto at = acted_.rbegin(); at != acted_.rend() && found.size() < kMostWaiting; ++at)
      if (isWanted(at->first) && graph_.factor(at->first).weight == 0 && !contains(some, at->first) &&
          !contains(later_, at->first) && !bindsUnconstrained(graph_, at->first))
        found.push_back(at->first);
    std::reverse(found.begin(), found.end());
    return found;
  }

  std::vector<FactorId> waiting(const std::vector<FactorId>& some) const {
    return waiting(some, [](FactorId) { return true; });
  }

  /// Decides about some of the fresh hypotheses; returns those that contradict the map.
  std::vector<FactorId> take(const std::vector<FactorId>& some) {
    std::vector<FactorId> candidates;
    for (const FactorId id : some)
      if (bindsUnconstrained(graph_, id)) {
        initializeUnconstrained(graph_, id);
        decide(id, true, 0, "the map does not determine yet what it measures");
      } else {
        candidates.push_back(id);
      }
    // A measurement that the map predicts within its own noise passes every gate, however certain the map is.
    if (std::all_of(candidates.begin(), candidates.end(), [this](FactorId id) { return misfit(id) <= bound(id); })) {
      for (const FactorId id : candidates) decide(id, true, misfit(id), "fits the map");
      return {};
    }
    const Marginals marginals(graph_);
    std::vector<Choice> choices = select(marginals, candidates);
    const bool some_wait = std::any_of(choices.begin(), choices.end(),
                                       [](const Choice& choice) { return choice.kind == Choice::Kind::waits; });
    if (const std::vector<FactorId> older = waiting(some); some_wait && !older.empty()) {
      candidates.insert(candidates.begin(), older.begin(), older.end());
      choices = select(marginals, candidates);
    }
    std::vector<FactorId> contradicting;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (contains(some, candidates[i]) || choices[i].kind == Choice::Kind::fits ||
          choices[i].kind == Choice::Kind::agrees)
        apply(candidates[i], choices[i], candidates);
      if (contains(some, candidates[i]) && choices[i].kind == Choice::Kind::contradicts)
        contradicting.push_back(candidates[i]);
    }
    return contradicting;
  }

  std::vector<Choice> select(const Marginals& marginals, const std::vector<FactorId>& candidates) const {
    const OutlierModel volume(graph_);
    std::vector<std::optional<double>> log_volumes;
    for (const FactorId id : candidates) log_volumes.push_back(volume.logOf(graph_.factor(id)));
    const Innovation innovation(graph_, marginals, candidates, options_.inflation);
    return options_.method == Method::pairwise ? selectPairwise(innovation, log_volumes, gate_)
                                               : selectGraduated(innovation, log_volumes, gate_);
  }

  /// Newly accepted factors may be so far from the current values that their robust loss leaves them hardly any weight,
  /// and the solution would stay in its local minimum. They are first solved without their loss.
  void solveWithoutLosses(const std::vector<FactorId>& acting_before) {
    constexpr double kHardlyAny = 0.02;  // of its weight: at 14 standard deviations for a Cauchy loss of scale 2
    std::vector<std::pair<FactorId, Loss>> far;
    for (const FactorId id : acting()) {
      const FactorRecord& record = graph_.factor(id);
      if (contains(acting_before, id) || record.loss.evaluate(misfit(id)).first_derivative > kHardlyAny) continue;
      far.emplace_back(id, record.loss);
    }
    if (far.empty()) return;
    for (const auto& [id, loss] : far) graph_.setLoss(id, Loss::none());
    minimizer_.minimize(graph_, solve_options_);
    for (const auto& [id, loss] : far) graph_.setLoss(id, loss);
  }

  std::vector<FactorId> acting() const {
    std::vector<FactorId> all;
    for (const auto& [id, acted] : acted_) {
      if (graph_.factor(id).weight > 0) all.push_back(id);
    }
    return all;
  }

  /// The hypotheses that act and did not before.
  std::vector<FactorId> newOf(const std::vector<FactorId>& acting_before) const {
    std::vector<FactorId> all = acting();
    all.erase(std::remove_if(all.begin(), all.end(), [&](FactorId id) { return contains(acting_before, id); }),
              all.end());
    return all;
  }

  void apply(FactorId id, const Choice& choice, const std::vector<FactorId>& candidates) {
    std::optional<FactorId> with;
    if (choice.with) with = candidates[*choice.with];
    switch (choice.kind) {
      case Choice::Kind::fits:
        return decide(id, true, choice.chi2, "fits the map");
      case Choice::Kind::agrees:
        return decide(id, true, choice.chi2, "fits the map and agrees with another hypothesis", with);
      case Choice::Kind::waits:
        return decide(id, false, choice.chi2,
                      "waits for another hypothesis that confirms it: the map is so uncertain "
                      "there that it could fit by chance");
      case Choice::Kind::contradicts:
        return decide(id, false, choice.chi2, with ? "contradicts another hypothesis" : "contradicts the map", with);
    }
  }

  void reviseBy(const std::vector<FactorId>& contradicting) {
    const auto revised =
        reviseHypotheses(graph_, contradicting, waiting(contradicting), gate_, options_.inflation, solve_options_);
    if (!revised) return;
    const FactorId first = revised->accepted.front();
    const std::string others = std::to_string(revised->accepted.size() - 1) + " others";
    for (const FactorId id : revised->accepted)
      decide(id, true, misfit(id),
             revised->taken_back.empty() ? "fits the map together with " + others + " that agree with it"
                                         : "agrees with " + others + " that replace hypotheses that acted before");
    for (const FactorId id : revised->taken_back)
      decide(id, false, misfit(id), "taken back: contradicts others that agree with one another", first);
    minimizer_.minimize(graph_, solve_options_);
  }

  /// Tries each waiting hypothesis about points: it is accepted if others fit once it acts. Hypotheses about poses form
  /// cycles, which reviseHypotheses() examines.
  void confirmByOthers(const std::vector<FactorId>& some) {
    const auto isOfPoints = [&](FactorId id) { return graph_.factor(id).factor->kind() == SamePointFactor::kKind; };
    for (auto id = some.rbegin(); id != some.rend(); ++id) {
      if (graph_.factor(*id).weight > 0 || !isOfPoints(*id) || bindsUnconstrained(graph_, *id)) continue;
      const std::vector<FactorId> pool = waiting({*id}, isOfPoints);
      if (pool.empty()) continue;
      RevisionTrial trial(graph_, gate_, options_.inflation, solve_options_);
      if (!trial.isConfirmed(*id, pool)) continue;
      std::swap(graph_, trial.graph());
      for (const FactorId accepted : trial.outcome().accepted)
        decide(accepted, true, misfit(accepted), "fits the map and is confirmed by others that fit once it acts");
      return;
    }
  }

  /// Takes back the worst hypothesis first, and solves the rest before the next one.
  void takeBackWhatNoLongerFits() {
    while (true) {
      std::optional<FactorId> worst;
      double worst_ratio = 1;
      for (const auto& [id, acted] : acted_) {
        if (graph_.factor(id).weight == 0) continue;
        const double ratio = misfit(id) / bound(id);
        if (ratio <= worst_ratio) continue;
        worst = id;
        worst_ratio = ratio;
      }
      if (!worst) return;
      decide(*worst, false, misfit(*worst),
             acted_.at(*worst) ? "taken back: no longer fits the map" : "contradicts the map");
      minimizer_.minimize(graph_, solve_options_);
    }
  }

  void acceptWhatFitsNow() {
    bool changed = false;
    for (const auto& [id, acted] : acted_) {
      if (graph_.factor(id).weight > 0 || contains(later_, id) || bindsUnconstrained(graph_, id)) continue;
      const double chi2 = misfit(id), most = bound(id);
      if (chi2 > most) continue;
      decide(id, true, chi2, "fits the map as it is now");
      changed = true;
    }
    if (changed) minimizer_.minimize(graph_, solve_options_);
  }

  std::vector<HypothesisVerdict> verdicts() const {
    std::vector<HypothesisVerdict> all;
    for (const FactorId id : fresh_) all.push_back(verdicts_.at(id));
    for (const auto& [id, verdict] : verdicts_)
      if (verdict.changed && !contains(fresh_, id)) all.push_back(verdict);
    return all;
  }

  Graph& graph_;
  const std::vector<FactorId>& fresh_;
  std::vector<FactorId> later_;  // fresh ones that are not judged yet
  const ConsistencyOptions& options_;
  const SolveOptions& solve_options_;
  Minimizer& minimizer_;
  Gate gate_;
  std::map<FactorId, bool> acted_;  // whether each hypothesis acted before
  std::map<FactorId, HypothesisVerdict> verdicts_;
};

}  // namespace

std::vector<HypothesisVerdict> testConsistency(Graph& graph, const std::vector<FactorId>& fresh,
                                               const ConsistencyOptions& options, const SolveOptions& solve_options,
                                               Minimizer& minimizer) {
  return Test(graph, fresh, options, solve_options, minimizer).run();
}

std::vector<HypothesisVerdict> testConsistency(Graph& graph, const std::vector<FactorId>& fresh,
                                               const ConsistencyOptions& options, const SolveOptions& solve_options) {
  BatchMinimizer batch;
  return testConsistency(graph, fresh, options, solve_options, batch);
}

}  // namespace omnimapper::graph
