#include "EasedSolve.h"

#include <algorithm>

#include "omnimapper/graph/PointFactor.h"

namespace omnimapper::graph {

void solveEased(Graph& graph, const std::vector<base::FactorId>& fresh, const SolveOptions& options,
                Minimizer& minimizer) {
  constexpr double kFar = 1e4;     // smallest chi-square of a factor whose weight starts small
  constexpr double kGentle = 100;  // chi-square of the worst factor at its first weight
  constexpr double kGrowth = 100;  // growth of the weight from solve to solve
  constexpr double kLeast = 1e-10;
  std::vector<base::FactorId> far;
  double worst = 0;
  for (const auto id : fresh) {
    const FactorRecord& record = graph.factor(id);
    if (record.weight == 0 || record.factor->kind() != SamePointFactor::kKind) continue;
    const double misfit = graph.whitenedResidual(id).squaredNorm();
    if (misfit < kFar) continue;
    far.push_back(id);
    worst = std::max(worst, misfit);
  }
  for (double weight = std::max(kGentle / worst, kLeast); !far.empty() && weight < 1; weight *= kGrowth) {
    for (const auto id : far) graph.setWeight(id, weight);
    minimizer.minimize(graph, options);
  }
  for (const auto id : far) graph.setWeight(id, 1);
  minimizer.minimize(graph, options);
}

}  // namespace omnimapper::graph
