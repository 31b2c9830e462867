#include "EliminationOrder.h"

#include <cholmod.h>
#include <omnimapper/base/Error.h>

#include <algorithm>
#include <numeric>

namespace omnimapper::graph {

namespace {

/// For each node the others that it shares a set with, as columns of a symmetric matrix; ascending.
struct Pattern {
  std::vector<int> starts, rows;
};

Pattern patternOf(int count, const std::vector<std::vector<int>>& sets) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(count));
  for (const auto& set : sets)
    for (const int a : set)
      for (const int b : set)
        if (a != b) neighbours[a].push_back(b);
  Pattern pattern;
  pattern.starts.push_back(0);
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    pattern.rows.insert(pattern.rows.end(), list.begin(), list.end());
    pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
  }
  return pattern;
}

class Camd {
 public:
  Camd() {
    cholmod_start(&common_);
    common_.print = 0;
  }
  ~Camd() { cholmod_finish(&common_); }
  Camd(const Camd&) = delete;
  Camd& operator=(const Camd&) = delete;

  std::vector<int> order(int count, Pattern& pattern, std::vector<int> sets) {
    cholmod_sparse matrix{};
    matrix.nrow = matrix.ncol = static_cast<std::size_t>(count);
    matrix.nzmax = pattern.rows.size();
    matrix.p = pattern.starts.data();
    matrix.i = pattern.rows.data();
    matrix.stype = 1;  // the lower triangle is ignored
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = CHOLMOD_PATTERN;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = matrix.packed = 1;
    std::vector<int> order(static_cast<std::size_t>(count));
    if (!cholmod_camd(&matrix, nullptr, 0, sets.data(), order.data(), &common_))
      throw base::Error(base::ExitCode::internal, "graph: CHOLMOD cannot order this system: too large for the memory");
    return order;
  }

 private:
  cholmod_common common_;
};

/// The nodes that each is bound to when it is eliminated, as places in the order; ascending.
std::vector<std::vector<int>> structureOf(const Pattern& pattern, const std::vector<int>& order,
                                          const std::vector<int>& place) {
  std::vector<std::vector<int>> structure(order.size()), children(order.size());
  std::vector<int> merged;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::vector<int>& later = structure[i];
    for (int at = pattern.starts[order[i]]; at < pattern.starts[order[i] + 1]; ++at)
      if (place[pattern.rows[at]] > static_cast<int>(i)) later.push_back(place[pattern.rows[at]]);
    std::sort(later.begin(), later.end());
    for (const int child : children[i]) {
      merged.clear();
      std::set_union(later.begin(), later.end(), structure[child].begin() + 1, structure[child].end(),
                     std::back_inserter(merged));
      later.swap(merged);
    }
    if (!later.empty()) children[later.front()].push_back(static_cast<int>(i));
  }
  return structure;
}

}  // namespace

std::vector<Supernode> orderElimination(int count, const std::vector<std::vector<int>>& sets,
                                        const std::vector<bool>& last) {
  Pattern pattern = patternOf(count, sets);
  std::vector<int> groups(last.begin(), last.end());
  if (std::find(groups.begin(), groups.end(), 0) == groups.end()) std::fill(groups.begin(), groups.end(), 0);
  const std::vector<int> order = Camd().order(count, pattern, groups);
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  const auto structure = structureOf(pattern, order, place);

  // A node joins the supernode of its parent where it adds no fill; of several children only one can.
  std::vector<int> joined(order.size(), -1);  // the child that joins
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (structure[i].empty()) continue;
    const int parent = structure[i].front();
    if (structure[i].size() == structure[parent].size() + 1 && joined[parent] < 0) joined[parent] = static_cast<int>(i);
  }
  std::vector<Supernode> supernodes;
  std::vector<int> supernode_of(order.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    int number = joined[i] < 0 ? -1 : supernode_of[joined[i]];
    if (number < 0) {
      number = static_cast<int>(supernodes.size());
      supernodes.emplace_back();
    }
    supernode_of[i] = number;
    supernodes[number].frontals.push_back(order[i]);
    supernodes[number].separator = structure[i];  // places, for now
  }
  // Those that began early may end after their parents began: sorted by their last node, each comes before its parent.
  std::vector<int> by_end(supernodes.size()), number_of(supernodes.size());
  std::iota(by_end.begin(), by_end.end(), 0);
  std::sort(by_end.begin(), by_end.end(),
            [&](int a, int b) { return place[supernodes[a].frontals.back()] < place[supernodes[b].frontals.back()]; });
  for (std::size_t i = 0; i < by_end.size(); ++i) number_of[by_end[i]] = static_cast<int>(i);
  std::vector<Supernode> sorted;
  for (const int number : by_end) {
    Supernode& supernode = supernodes[number];
    if (!supernode.separator.empty()) supernode.parent = number_of[supernode_of[supernode.separator.front()]];
    for (int& node : supernode.separator) node = order[node];
    sorted.push_back(std::move(supernode));
  }
  return sorted;
}

}  // namespace omnimapper::graph
