#include "omnimapper/graph/GraphChanges.h"

#include <algorithm>

namespace omnimapper::graph {

namespace {

bool actAlike(const FactorRecord& a, const FactorRecord& b) {
  return a.factor == b.factor && a.weight == b.weight && a.variables == b.variables && a.loss.kind() == b.loss.kind() &&
         a.loss.scale() == b.loss.scale() && a.noise.matrix() == b.noise.matrix();
}

}  // namespace

GraphChanges changesBetween(const Graph& before, const Graph& after) {
  GraphChanges changes;
  after.factors().visitUnshared(before.factors(),
                                [&](base::FactorId id, const FactorRecord* now, const FactorRecord* then) {
                                  if (!then)
                                    changes.added.push_back(id);
                                  else if (!now)
                                    changes.removed.push_back(id);
                                  else if (!actAlike(*now, *then))
                                    changes.changed.push_back(id);
                                });
  after.variables().visitUnshared(before.variables(),
                                  [&](base::VariableId id, const VariableRecord* now, const VariableRecord* then) {
                                    if (!now || !then || (now->fixed == then->fixed && now->value == then->value))
                                      return;
                                    if (!now->fixed && !then->fixed) return changes.moved.push_back(id);
                                    for (const auto factor : now->factors)
                                      if (before.contains(factor)) changes.changed.push_back(factor);
                                  });
  auto& changed = changes.changed;
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changes;
}

}  // namespace omnimapper::graph
