#include "StaticWeights.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/SolveOne.h>
#include <omnimapper/graph/Solver.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace omnimapper::plugins {

namespace {

constexpr double kSettled = 0.01;  // largest change of a weight that counts as converged
constexpr double kRelaxation = 2;  // ratio of lambda in one round to that in the next
constexpr int kMostRounds = 20;
constexpr double kLargestScale = 1 << kMostRounds;  // limits the number of rounds if a chi-square is not finite

// Twice lambda. The weight is 0.9 at a chi-square of a tenth of it, and 99 of 100 static landmarks have a smaller one.
double twiceLambda(const WeighedLandmark& landmark) {
  return 10 * graph::chiSquareQuantile(0.99, landmark.degrees_of_freedom);
}

class WeightEm {
 public:
  WeightEm(const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks)
      : result_{graph, landmarks, 0, 0} {}

  Weighing fromCurrentMap() {
    reweigh(1);
    settle();
    return conclude();
  }

  Weighing fromFullWeights() {
    for (auto& landmark : result_.landmarks) setWeight(landmark, 1);
    solve();
    double largest = 1;
    measure();
    for (const auto& landmark : result_.landmarks) largest = std::max(largest, landmark.chi2 / twiceLambda(landmark));
    for (double scale = std::min(2 * largest, kLargestScale); scale > 1; scale /= kRelaxation) {
      reweigh(scale);
      solve();
    }
    reweigh(1);
    settle();
    return conclude();
  }

 private:
  void settle() {
    for (int round = 0; round < kMostRounds; ++round) {
      solve();
      if (reweigh(1) < kSettled) return;
    }
  }

  void solve() {
    ++result_.rounds;
    graph::solve(result_.graph, {graph::SolveOptions::Method::levenberg_marquardt, 20, 1e-4, {}});
  }

  // The M step; returns the largest change of a weight.
  double reweigh(double scale) {
    measure();
    double change = 0;
    for (auto& landmark : result_.landmarks) {
      const double weight = std::max(0.0, 1 - landmark.chi2 / (scale * twiceLambda(landmark)));
      change = std::max(change, std::abs(weight - landmark.weight));
      setWeight(landmark, weight);
    }
    return change;
  }

  void setWeight(WeighedLandmark& landmark, double weight) {
    landmark.weight = weight;
    for (const auto id : landmark.measurements) result_.graph.setWeight(id, weight);
  }

  // Computes the chi-square of each landmark's measurements at full weight, with the landmark at the values that fit
  // them best. A landmark without weight is moved there first, because the solver has left it where it was.
  void measure() {
    for (auto& landmark : result_.landmarks) {
      for (const auto id : landmark.measurements) result_.graph.setWeight(id, 1);
      for (const auto id : landmark.variables) graph::solveOne(result_.graph, id);
      landmark.chi2 = 0;
      for (const auto id : landmark.measurements) {
        const double s = result_.graph.whitenedResidual(id).squaredNorm();
        landmark.chi2 += result_.graph.factor(id).loss.evaluate(s).rho;
      }
      for (const auto id : landmark.measurements) result_.graph.setWeight(id, landmark.weight);
    }
  }

  // For the comparison of results, a landmark without weight costs as much as two landmarks, one at each of two places.
  // With lambda instead, which is large, a distorted map that keeps a few more landmarks could win.
  Weighing conclude() {
    result_.cost = 2 * result_.graph.cost();
    for (const auto& landmark : result_.landmarks) {
      int rows = 0;
      for (const auto id : landmark.variables) rows += result_.graph.variable(id).kind->tangentSize();
      const double as_two = landmark.degrees_of_freedom + graph::chiSquareQuantile(0.999, rows);
      result_.cost += (1 - landmark.weight) * as_two;
    }
    return std::move(result_);
  }

  Weighing result_;
};

}  // namespace

std::vector<WeighedLandmark> landmarksToWeigh(const mapper::State& state, const std::vector<std::string>& sections) {
  std::vector<WeighedLandmark> all;
  const std::set<std::string> named(sections.begin(), sections.end());
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state != map::Landmark::State::active || landmark.variables.empty()) continue;
    if (!named.empty() && named.count(landmark.owner) == 0) continue;
    WeighedLandmark weighed;
    weighed.id = id;
    weighed.variables = landmark.variables;
    for (const auto variable : landmark.variables)
      weighed.degrees_of_freedom -= state.graph.variable(variable).kind->tangentSize();
    for (const auto factor : state.factorsOf(id)) {
      const graph::FactorRecord& record = state.graph.factor(factor);
      if (record.tags.hypothesis || record.variables.size() <= landmark.variables.size()) continue;
      weighed.measurements.push_back(factor);
      weighed.degrees_of_freedom += record.noise.size();
    }
    for (const auto factor : factorsOfItself(weighed, state.graph))
      weighed.degrees_of_freedom += state.graph.factor(factor).noise.size();
    if (weighed.degrees_of_freedom > 0) all.push_back(std::move(weighed));
  }
  return all;
}

std::vector<base::FactorId> factorsOfItself(const WeighedLandmark& landmark, const graph::Graph& graph) {
  const std::set<base::VariableId> own(landmark.variables.begin(), landmark.variables.end());
  std::set<base::FactorId> found;
  for (const auto variable : own) {
    for (const auto id : graph.factorsOf(variable)) {
      const auto& record = graph.factor(id);
      const bool of_itself = std::all_of(record.variables.begin(), record.variables.end(),
                                         [&](const auto bound) { return own.count(bound) > 0; });
      if (of_itself && !record.tags.hypothesis) found.insert(id);
    }
  }
  return {found.begin(), found.end()};
}

Weighing weighLandmarks(const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks) {
  Weighing from_current = WeightEm(graph, landmarks).fromCurrentMap();
  const bool all_fit = std::all_of(from_current.landmarks.begin(), from_current.landmarks.end(),
                                   [](const auto& landmark) { return landmark.weight > 0.5; });
  if (all_fit) return from_current;
  Weighing from_full = WeightEm(graph, landmarks).fromFullWeights();
  from_full.rounds += from_current.rounds;
  from_current.rounds = from_full.rounds;
  return from_full.cost < from_current.cost ? std::move(from_full) : std::move(from_current);
}

}  // namespace omnimapper::plugins
