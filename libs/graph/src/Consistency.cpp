#include "omnimapper/graph/Consistency.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "ChiSquare.h"
#include "Innovation.h"

namespace omnimapper::graph {

namespace {

using base::FactorId;

/// What is refused comes back only where it fits well: what is on the edge would go to and fro.
constexpr double kReturnConfidence = 0.95;

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", number);
  return text;
}

/// One run of the test.
class Test {
 public:
  Test(Graph& graph, const std::vector<FactorId>& fresh, const ConsistencyOptions& options,
       const SolveOptions& solve_options)
      : graph_(graph), fresh_(fresh), options_(options), solve_options_(solve_options) {
    for (const FactorId id : fresh_)
      if (!graph_.factor(id).tags.hypothesis)
        throw base::Error(base::ExitCode::internal, "consistency test: factor " + toString(id) + " is no hypothesis");
    for (const auto& [id, record] : graph_.factors())
      if (record.tags.hypothesis) before_[id] = record.weight > 0;
  }

  std::vector<Verdict> run() {
    if (options_.method == ConsistencyOptions::Method::none) {
      for (const FactorId id : fresh_) accept(id, 0, "taken without test");
    } else {
      for (const FactorId id : fresh_) graph_.setWeight(id, 0);
      takeFresh();
    }
    solve(graph_, solve_options_);
    if (options_.method != ConsistencyOptions::Method::none) review();
    return verdicts();
  }

 private:
  double gate(FactorId id) const { return gate(rowsOf(id)); }
  double gate(int rows) const { return chiSquareQuantile(options_.confidence, rows); }
  int rowsOf(FactorId id) const { return graph_.factor(id).factor->residualSize(); }
  double misfit(FactorId id) const { return graph_.whitenedResidual(id).squaredNorm(); }

  void accept(FactorId id, double chi2, const std::string& reason) { decide(id, true, chi2, reason); }
  void decide(FactorId id, bool accepted, double chi2, const std::string& reason,
              std::optional<FactorId> against = std::nullopt) {
    graph_.setWeight(id, accepted ? 1 : 0);
    verdicts_[id] = {id, accepted, false, chi2, rowsOf(id), reason, against};
  }

  /// True if a variable of the factor is held by nothing yet, so that there is nothing to test it against.
  bool reachesOut(FactorId id) const {
    const auto& variables = graph_.factor(id).variables;
    return std::any_of(variables.begin(), variables.end(), [this](base::VariableId variable) {
      const std::vector<FactorId>& factors = graph_.factorsOf(variable);
      return std::none_of(factors.begin(), factors.end(),
                          [this](FactorId factor) { return graph_.factor(factor).weight > 0; });
    });
  }

  /// Those that fit what the graph knows, the best known first, each given those before it.
  void takeFresh() {
    std::vector<FactorId> judged;
    for (const FactorId id : fresh_)
      if (reachesOut(id))
        accept(id, 0, "nothing is known of what it measures");
      else
        judged.push_back(id);
    if (judged.empty()) return;
    Innovation innovation(graph_, Marginals(graph_), judged, options_.inflation);
    std::vector<int> order(judged.size());
    std::vector<double> vagueness;
    for (int i = 0; i < innovation.size(); ++i) {
      order[i] = i;
      vagueness.push_back(innovation.vagueness(i));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return vagueness[a] < vagueness[b]; });
    for (const int i : order) {
      const FactorId id = judged[i];
      const double chi2 = innovation.chi2(i), bound = gate(id);
      if (chi2 > bound) {
        decide(id, false, chi2, "does not fit the map (chi-square " + rounded(chi2) + " > " + rounded(bound) + ")");
      } else {
        accept(id, chi2, "fits the map (chi-square " + rounded(chi2) + " <= " + rounded(bound) + ")");
        innovation.condition(i);
      }
    }
  }

  /// Takes back what no longer fits, worst first; lets in again what fits now.
  void review() {
    while (true) {
      std::optional<FactorId> worst;
      double worst_ratio = 1;
      for (const auto& [id, was_accepted] : before_) {
        if (graph_.factor(id).weight == 0) continue;
        const double ratio = misfit(id) / gate(id);
        if (ratio > worst_ratio) {
          worst = id;
          worst_ratio = ratio;
        }
      }
      if (!worst) break;
      const double chi2 = misfit(*worst);
      decide(*worst, false, chi2,
             "taken back: no longer fits (chi-square " + rounded(chi2) + " > " + rounded(gate(*worst)) + ")");
      solve(graph_, solve_options_);
    }
    bool returned = false;
    for (const auto& [id, was_accepted] : before_) {
      if (graph_.factor(id).weight > 0 || verdicts_.count(id) > 0) continue;
      const double chi2 = misfit(id), bound = chiSquareQuantile(kReturnConfidence, rowsOf(id));
      if (chi2 > bound) continue;
      accept(id, chi2, "fits the map as it is now (chi-square " + rounded(chi2) + " <= " + rounded(bound) + ")");
      returned = true;
    }
    if (returned) solve(graph_, solve_options_);
  }

  std::vector<Verdict> verdicts() {
    std::vector<Verdict> all;
    for (const FactorId id : fresh_) all.push_back(verdicts_.at(id));
    for (const auto& [id, verdict] : verdicts_)
      if (std::find(fresh_.begin(), fresh_.end(), id) == fresh_.end() && verdict.accepted != before_.at(id))
        all.push_back(verdict);
    for (Verdict& verdict : all) verdict.changed = verdict.accepted != before_.at(verdict.factor);
    return all;
  }

  Graph& graph_;
  const std::vector<FactorId>& fresh_;
  const ConsistencyOptions& options_;
  const SolveOptions& solve_options_;
  std::map<FactorId, bool> before_;  // of every hypothesis: did it act
  std::map<FactorId, Verdict> verdicts_;
};

}  // namespace

std::vector<Verdict> testConsistency(Graph& graph, const std::vector<FactorId>& fresh,
                                     const ConsistencyOptions& options, const SolveOptions& solve_options) {
  return Test(graph, fresh, options, solve_options).run();
}

}  // namespace omnimapper::graph
