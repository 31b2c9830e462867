#include "Overturn.h"

#include <algorithm>
#include <unordered_set>

#include "PoseCycle.h"

namespace omnimapper::graph {

namespace {

using base::FactorId;
using base::VariableId;

int doublings(std::size_t number) {
  int count = -1;
  for (; number > 0; number /= 2) ++count;
  return count;
}

/// The largest group of refused and waiting ones that agree pair by pair, each predicting the other sharply.
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
    auto surprise = poseCycle(graph_, marginals_, a, b, inflation_);
    if (!surprise) surprise = Innovation(graph_, marginals_, {a, b}, inflation_).given(1, 0);
    return gate_.passes(*surprise) && gate_.margin(*surprise, volume_.logOf(graph_.factor(b))) >= 0;
  }

  const Graph& graph_;
  const Marginals& marginals_;
  const Gate& gate_;
  double inflation_;
  FalseVolume volume_;
};

/// The hypotheses that act, in groups of those whose variables are near one another along what is trusted.
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

/// The acting groups without which the refused ones would fit best, best first.
std::vector<std::vector<FactorId>> suspects(const Graph& graph, const Marginals& marginals,
                                            const std::vector<FactorId>& group) {
  constexpr std::size_t kMost = 3;
  const std::vector<FactorId> ends = {group.front(), group.back()};
  std::vector<std::pair<double, std::vector<FactorId>>> ranked;
  for (const std::vector<FactorId>& acting : actingGroups(graph)) {
    std::vector<FactorId> all = ends;
    all.insert(all.end(), acting.begin(), acting.end());
    const Innovation innovation(graph, marginals, all, 1);
    std::vector<int> places;
    for (std::size_t i = 0; i < acting.size(); ++i) places.push_back(static_cast<int>(i) + 2);
    const double before = innovation.of(0).chi2() + innovation.of(1).chi2();
    const double after = innovation.without(0, places).chi2() + innovation.without(1, places).chi2();
    if (after < 0.5 * before) ranked.emplace_back(after, acting);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (ranked.size() > kMost) ranked.resize(kMost);
  std::vector<std::vector<FactorId>> groups;
  for (const auto& [chi2, acting] : ranked) groups.push_back(acting);
  return groups;
}

/// The graph with a group in place of suspects, and whether it is the better one.
class Trial {
 public:
  Trial(const Graph& graph, const Gate& gate, double inflation, const SolveOptions& solve_options)
      : graph_(graph), gate_(gate), inflation_(inflation), solve_options_(solve_options) {}

  bool succeeds(const std::vector<FactorId>& group, const std::vector<FactorId>& suspects) {
    const double before = truncatedCost(group);
    for (const FactorId id : suspects) graph_.setWeight(id, 0);
    solve(graph_, solve_options_);
    if (!hasRoomFor(group)) return false;
    for (const FactorId id : group) graph_.setWeight(id, 1);
    solve(graph_, solve_options_);
    for (const FactorId id : group)
      if (misfit(id) > bound(id)) return false;
    const double after = truncatedCost(suspects);
    for (const FactorId id : suspects)
      if (misfit(id) > bound(id))
        taken_back_.push_back(id);
      else
        graph_.setWeight(id, 1);
    return group.size() > taken_back_.size() && after < before;
  }
  Graph& graph() { return graph_; }
  const std::vector<FactorId>& takenBack() const { return taken_back_; }

 private:
  double bound(FactorId id) const { return gate_.bound(graph_.factor(id).factor->residualSize()); }
  double misfit(FactorId id) const { return graph_.whitenedResidual(id).squaredNorm(); }
  /// Chi-square of what acts, and of these, which do not, up to the bound of each.
  double truncatedCost(const std::vector<FactorId>& refused) const {
    double cost = 2 * graph_.cost();
    for (const FactorId id : refused) cost += std::min(misfit(id), bound(id));
    return cost;
  }
  bool hasRoomFor(const std::vector<FactorId>& group) const {
    const Innovation innovation(graph_, Marginals(graph_), group, inflation_);
    for (int i = 0; i < innovation.size(); ++i)
      if (!gate_.passes(innovation.of(i))) return false;
    return true;
  }

  Graph graph_;
  const Gate& gate_;
  double inflation_;
  const SolveOptions& solve_options_;
  std::vector<FactorId> taken_back_;
};

}  // namespace

std::optional<Overturned> overturn(Graph& graph, const std::vector<FactorId>& refused,
                                   const std::vector<FactorId>& waiting, const Gate& gate, double inflation,
                                   const SolveOptions& solve_options) {
  const Marginals marginals(graph);
  const std::vector<FactorId> group = Group(graph, marginals, gate, inflation).largest(refused, waiting);
  if (group.empty()) return std::nullopt;
  for (const std::vector<FactorId>& acting : suspects(graph, marginals, group)) {
    Trial trial(graph, gate, inflation, solve_options);
    if (!trial.succeeds(group, acting)) continue;
    std::swap(graph, trial.graph());
    return Overturned{group, trial.takenBack()};
  }
  return std::nullopt;
}

}  // namespace omnimapper::graph
