#include "RevisionTrial.h"

#include <algorithm>

#include "EasedSolve.h"
#include "UnconstrainedVariables.h"

namespace omnimapper::graph {

using base::FactorId;

bool RevisionTrial::succeeds(const std::vector<FactorId>& group, const std::vector<FactorId>& pool,
                             const std::vector<FactorId>& suspects) {
  std::vector<FactorId> all = pool;
  all.insert(all.end(), suspects.begin(), suspects.end());
  const double before = truncatedCost(all);
  for (const FactorId id : suspects) graph_.setWeight(id, 0);
  solve(graph_, solve_options_);
  while (admit(group)) {
  }
  if (2 * outcome_.accepted.size() <= group.size()) return false;
  // The hypotheses that act now may allow others of the pool to act.
  while (admit(pool)) {
  }
  for (const FactorId id : outcome_.accepted)
    if (misfit(id) > bound(id)) return false;
  const double after = truncatedCost(all);
  for (const FactorId id : suspects)
    if (misfit(id) > bound(id))
      outcome_.taken_back.push_back(id);
    else
      graph_.setWeight(id, 1);
  return outcome_.accepted.size() > outcome_.taken_back.size() && after < before;
}

bool RevisionTrial::fitsBeside(const std::vector<FactorId>& group) {
  const double before = 2 * graph_.cost();
  int others = 0;
  for (const FactorId id : group) {
    graph_.setWeight(id, 1);
    if (id != group.front()) others += graph_.factor(id).factor->residualSize();
  }
  solve(graph_, solve_options_);
  for (const FactorId id : group)
    if (misfit(id) > bound(id)) return false;
  outcome_.accepted = group;
  return 2 * graph_.cost() - before <= bound(group.front()) + others;
}

bool RevisionTrial::isConfirmed(FactorId id, const std::vector<FactorId>& pool) {
  const double before = 2 * graph_.cost();
  graph_.setWeight(id, 1);
  BatchMinimizer batch;
  solveEased(graph_, {id}, solve_options_, batch);
  outcome_.accepted = {id};
  if (misfit(id) > bound(id) || !admit(pool)) return false;
  // Noise raises chi-square by 1 for each row, and the likelihood ratio that is required of a hypothesis allows each of
  // the others to raise it further.
  double most = bound(id);
  for (const FactorId accepted : outcome_.accepted) {
    if (misfit(accepted) > bound(accepted)) return false;
    if (accepted != id) most += graph_.factor(accepted).factor->residualSize() + gate_.chi2OfRatio();
  }
  return 2 * graph_.cost() - before <= most;
}

/// Chi-square of all that acts, plus that of the hypotheses in `some` that do not, each up to its bound.
double RevisionTrial::truncatedCost(const std::vector<FactorId>& some) const {
  double cost = 2 * graph_.cost();
  for (const FactorId id : some)
    if (graph_.factor(id).weight == 0) cost += std::min(misfit(id), bound(id));
  return cost;
}

/// Lets all hypotheses of the pool act that can, and solves. Returns false if there are none.
bool RevisionTrial::admit(const std::vector<FactorId>& pool) {
  std::vector<FactorId> candidates;
  for (const FactorId id : pool)
    if (graph_.factor(id).weight == 0) candidates.push_back(id);
  if (candidates.empty()) return false;
  const auto out =
      std::find_if(candidates.begin(), candidates.end(), [&](FactorId id) { return bindsUnconstrained(graph_, id); });
  if (out != candidates.end()) {
    initializeUnconstrained(graph_, *out);
    outcome_.accepted.push_back(*out);
    solve(graph_, solve_options_);
    return true;
  }
  const OutlierModel volume(graph_);
  std::vector<std::optional<double>> log_volumes;
  for (const FactorId id : candidates) log_volumes.push_back(volume.logOf(graph_.factor(id)));
  const std::vector<Choice> choices =
      selectPairwise(Innovation(graph_, Marginals(graph_), candidates, inflation_), log_volumes, gate_);
  std::vector<FactorId> some;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (choices[i].kind == Choice::Kind::fits || choices[i].kind == Choice::Kind::agrees) {
      graph_.setWeight(candidates[i], 1);
      outcome_.accepted.push_back(candidates[i]);
      some.push_back(candidates[i]);
    }
  BatchMinimizer batch;
  if (!some.empty()) solveEased(graph_, some, solve_options_, batch);
  return !some.empty();
}

}  // namespace omnimapper::graph
