#include "HypothesisRevision.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "PoseCycle.h"
#include "RevisionTrial.h"
#include "omnimapper/graph/Linearized.h"

namespace omnimapper::graph {

namespace {

using base::FactorId;
using base::VariableId;

int doublings(std::size_t number) {
  int count = -1;
  for (; number > 0; number /= 2) ++count;
  return count;
}

std::vector<int> from(int first, int end) {
  std::vector<int> numbers;
  for (int i = first; i < end; ++i) numbers.push_back(i);
  return numbers;
}

/// The largest group of refused and waiting hypotheses that agree pair by pair, each predicting the other sharply.
class Group {
 public:
  Group(const Graph& graph, const Marginals& marginals, const Gate& gate, double inflation)
      : graph_(graph), marginals_(marginals), gate_(gate), inflation_(inflation), volume_(graph) {}

  std::vector<FactorId> largest(const std::vector<FactorId>& refused, const std::vector<FactorId>& waiting) const {
    std::vector<FactorId> pool = waiting, best;
    pool.insert(pool.end(), refused.begin(), refused.end());
    std::vector<FactorId> seeds = refused;
    while (!seeds.empty()) {
      std::vector<FactorId> group = {seeds.back()};
      for (auto other = pool.rbegin(); other != pool.rend(); ++other)
        if (*other != group[0] &&
            std::all_of(group.begin(), group.end(), [&](FactorId member) { return agree(member, *other); }))
          group.push_back(*other);
      seeds.erase(std::remove_if(seeds.begin(), seeds.end(), [&](FactorId seed) { return contains(group, seed); }),
                  seeds.end());
      if (group.size() > best.size()) best = group;
    }
    const auto old = static_cast<std::size_t>(
        std::count_if(best.begin(), best.end(), [&](FactorId id) { return contains(waiting, id); }));
    const bool grown = best.size() >= 2 && (old < 2 || doublings(best.size()) > doublings(old));
    return grown ? best : std::vector<FactorId>();
  }

  static bool contains(const std::vector<FactorId>& some, FactorId id) {
    return std::find(some.begin(), some.end(), id) != some.end();
  }

 private:
  bool agree(FactorId a, FactorId b) const {
    auto innovation = poseCycle(graph_, marginals_, a, b, inflation_);
    if (!innovation) innovation = onTheirOwn(a, b);
    return gate_.passes(*innovation) && gate_.margin(*innovation, volume_.logOf(graph_.factor(b))) >= 0;
  }

  /// The innovation of the second hypothesis if the first is true and the acting ones on the same variables are not.
  InnovationStatistics onTheirOwn(FactorId a, FactorId b) const {
    std::vector<FactorId> all = {a, b};
    for (const FactorId of : {a, b})
      for (const VariableId variable : graph_.factor(of).variables)
        for (const FactorId other : graph_.factorsOf(variable)) {
          const FactorRecord& record = graph_.factor(other);
          if (record.tags.hypothesis && record.weight > 0 && !contains(all, other)) all.push_back(other);
        }
    Innovation innovation(graph_, marginals_, all, 1);
    innovation.withdraw(from(2, innovation.size()));
    return innovation.given(1, 0);
  }

  const Graph& graph_;
  const Marginals& marginals_;
  const Gate& gate_;
  double inflation_;
  OutlierModel volume_;
};

/// The acting hypotheses, in groups whose variables are near one another along trusted factors.
std::vector<std::vector<FactorId>> actingGroups(const Graph& graph) {
  constexpr int kHops = 10;
  constexpr std::size_t kMostVariables = 200;
  std::vector<std::vector<FactorId>> groups;
  std::unordered_set<FactorId> grouped;
  for (const auto& [id, record] : graph.factors()) {
    if (!record.tags.hypothesis || record.weight == 0 || grouped.count(id) > 0) continue;
    std::vector<VariableId> near = record.variables;
    std::unordered_set<VariableId> reached(near.begin(), near.end());
    std::size_t begin = 0;
    for (int hop = 0; hop < kHops && near.size() < kMostVariables; ++hop) {
      const std::size_t end = near.size();
      for (; begin < end; ++begin)
        for (const FactorId factor : graph.factorsOf(near[begin])) {
          const FactorRecord& edge = graph.factor(factor);
          if (edge.tags.hypothesis || edge.weight == 0) continue;
          for (const VariableId next : edge.variables)
            if (reached.insert(next).second) near.push_back(next);
        }
    }
    std::vector<FactorId> group;
    for (const VariableId variable : near)
      for (const FactorId factor : graph.factorsOf(variable)) {
        const FactorRecord& other = graph.factor(factor);
        if (!other.tags.hypothesis || other.weight == 0 || grouped.count(factor) > 0) continue;
        const bool inside = std::all_of(other.variables.begin(), other.variables.end(),
                                        [&](VariableId end_of) { return reached.count(end_of) > 0; });
        if (!inside) continue;
        grouped.insert(factor);
        group.push_back(factor);
      }
    std::sort(group.begin(), group.end());
    groups.push_back(group);
  }
  return groups;
}

/// The influence of acting hypotheses on the measurement of another: the squared norm of the covariance of both
/// residuals.
class Influence {
 public:
  Influence(const Graph& graph, const Marginals& marginals, FactorId on, const std::vector<VariableId>& variables)
      : graph_(graph), jacobians_(Linearized(graph, on).jacobians) {
    for (std::size_t i = 0; i < variables.size(); ++i) places_.emplace(variables[i], i);
    for (const VariableId id : graph.factor(on).variables)
      covariances_.push_back(marginals.crossCovariances(id, variables));
  }
  double of(const std::vector<FactorId>& group) const {
    double sum = 0;
    for (const FactorId id : group) {
      const Linearized acting(graph_, id);
      const std::vector<VariableId>& variables = graph_.factor(id).variables;
      Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(acting.residual.size(), jacobians_[0].rows());
      for (std::size_t i = 0; i < variables.size(); ++i)
        for (std::size_t k = 0; k < jacobians_.size(); ++k)
          cross += acting.jacobians[i] * covariances_[k][places_.at(variables[i])] * jacobians_[k].transpose();
      sum += cross.squaredNorm();
    }
    return sum;
  }

 private:
  const Graph& graph_;
  std::vector<Eigen::MatrixXd> jacobians_;
  std::unordered_map<VariableId, std::size_t> places_;
  std::vector<std::vector<Eigen::MatrixXd>> covariances_;  // of each variable of `on` with those of the groups
};

/// Keeps the `most` items with the largest `key`, the largest first.
template <class Item, class Key>
void keepLargest(std::vector<Item>& items, std::size_t most, const Key& key) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < items.size(); ++i) order.emplace_back(-key(items[i]), i);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), most));
  std::vector<Item> kept;
  for (const auto& [negative, i] : order) kept.push_back(std::move(items[i]));
  items = std::move(kept);
}

/// The acting groups without which the refused hypotheses would fit best, the best first.
std::vector<std::vector<FactorId>> suspects(const Graph& graph, const Marginals& marginals,
                                            const std::vector<FactorId>& refused) {
  constexpr std::size_t kMostInfluential = 8, kMost = 3;
  std::vector<std::vector<FactorId>> groups = actingGroups(graph);
  std::vector<VariableId> variables;
  std::unordered_set<VariableId> seen;
  for (const std::vector<FactorId>& group : groups)
    for (const FactorId id : group)
      for (const VariableId variable : graph.factor(id).variables)
        if (seen.insert(variable).second) variables.push_back(variable);
  const Influence influence(graph, marginals, refused.front(), variables);
  keepLargest(groups, kMostInfluential, [&](const auto& group) { return influence.of(group); });
  const auto relief = [&](const std::vector<FactorId>& group) {
    std::vector<FactorId> all = {refused.front(), refused.back()};
    all.insert(all.end(), group.begin(), group.end());
    Innovation innovation(graph, marginals, all, 1);
    const double before = innovation.of(0).chi2() + innovation.of(1).chi2();
    innovation.withdraw(from(2, innovation.size()));
    return before / (innovation.of(0).chi2() + innovation.of(1).chi2());
  };
  keepLargest(groups, kMost, relief);
  groups.erase(std::remove_if(groups.begin(), groups.end(), [&](const auto& group) { return relief(group) < 2; }),
               groups.end());
  return groups;
}

}  // namespace

std::optional<RevisedHypotheses> reviseHypotheses(Graph& graph, const std::vector<FactorId>& refused,
                                                  const std::vector<FactorId>& waiting, const Gate& gate,
                                                  double inflation, const SolveOptions& solve_options) {
  const Marginals marginals(graph);
  const std::vector<FactorId> group = Group(graph, marginals, gate, inflation).largest(refused, waiting);
  if (group.empty()) return std::nullopt;
  RevisionTrial beside(graph, gate, inflation, solve_options);
  if (beside.fitsBeside(group)) {
    std::swap(graph, beside.graph());
    return beside.outcome();
  }
  std::vector<FactorId> pool = waiting;
  pool.insert(pool.end(), refused.begin(), refused.end());
  for (const std::vector<FactorId>& acting : suspects(graph, marginals, group)) {
    RevisionTrial trial(graph, gate, inflation, solve_options);
    if (!trial.succeeds(group, pool, acting)) continue;
    std::swap(graph, trial.graph());
    return trial.outcome();
  }
  return std::nullopt;
}

}  // namespace omnimapper::graph
