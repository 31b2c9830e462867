#pragma once

#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// A landmark with the weight of its measurements: about 1 if it is static, 0 if it was moved.
struct WeighedLandmark {
  base::LandmarkId id;
  std::vector<base::VariableId> variables;
  /// Factors that bind both the landmark and other variables, in the order of ids.
  std::vector<base::FactorId> measurements;
  int degrees_of_freedom = 0;  ///< rows of the landmark's factors minus the dimensions of its variables
  double chi2 = 0;             ///< of the measurements at full weight, with their losses applied
  double weight = 1;
};

/// The weights of landmarks, and the graph that was solved with them.
struct Weighing {
  graph::Graph graph;  ///< each measurement has the weight of its landmark
  std::vector<WeighedLandmark> landmarks;
  /// Chi-square of the graph, plus for each landmark (1 - weight) times what two landmarks would cost, one at each of
  /// two places.
  double cost = 0;
  int rounds = 0;
};

/// The active landmarks of these sections (of all sections if none is named) that were measured more often than is
/// needed to determine them. Hypotheses do not count as measurements, because the consistency test sets their weights.
std::vector<WeighedLandmark> landmarksToWeigh(const mapper::State& state, const std::vector<std::string>& sections);

/// The factors that bind only the landmark's variables, such as a prior: they apply wherever the landmark is.
std::vector<base::FactorId> factorsOfItself(const WeighedLandmark& landmark, const graph::Graph& graph);

/// Expectation maximization over one weight for each landmark (thesis 4.6.2.2). It minimizes
///   chi2 of all other factors + sum over landmarks of (weight * chi2 + lambda * (1 - weight)^2)
/// alternately over the map and the weights. lambda depends on a landmark's degrees of freedom, so that 99 of 100
/// static landmarks keep a weight of at least 0.9. The first run starts from the current map. If the weight of a
/// landmark falls to 0.5 or less in the first run, a second run starts from the map in which all landmarks have full
/// weight, and lowers lambda step by step (graduated non-convexity); the result with the lower cost is returned.
Weighing weighLandmarks(const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks);

}  // namespace omnimapper::plugins
