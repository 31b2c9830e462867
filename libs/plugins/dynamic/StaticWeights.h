#pragma once

#include <omnimapper/plugin/State.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// A landmark with the likelihood that it stands where it always stood.
struct WeighedLandmark {
  base::LandmarkId id;
  std::vector<base::VariableId> variables;
  std::vector<base::FactorId> measurements;  ///< factors that bind it to something else, in the order of ids
  int degrees_of_freedom = 0;                ///< rows beyond those that only tell where it is
  double chi2 = 0;                           ///< of the measurements, as their losses count them
  double weight = 1;
};

/// Weights of landmarks and the map that follows from them.
struct Weighing {
  graph::Graph graph;  ///< each measurement has the weight of its landmark
  std::vector<WeighedLandmark> landmarks;
  double cost = 0;  ///< chi-square of the whole, where a landmark without weight counts as one for each of two places
  int rounds = 0;
};

/// The active landmarks of these sections (of all, if none is named) that were seen more often than it takes to tell
/// where they are. Hypotheses are the consistency test's.
std::vector<WeighedLandmark> landmarksToWeigh(const mapper::State& state, const std::vector<std::string>& sections);

/// Factors that speak of nothing but the landmark, such as a prior: they hold wherever it is.
std::vector<base::FactorId> factorsOfItself(const WeighedLandmark& landmark, const graph::Graph& graph);

/// Expectation maximisation over one weight for each landmark (thesis 4.6.2.2): the least of
///   chi2 of all else + sum over landmarks of weight chi2 + lambda (1 - weight)^2
/// by turns over map and weights. lambda goes with a landmark's degrees of freedom: a static one keeps at least 0.9.
/// It starts from the map as it stands; where landmarks lose weight there, once more from the map in which all of them
/// count, with lambda lowered by degrees (graduated non-convexity), and the likelier of both is taken.
Weighing weighLandmarks(const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks);

}  // namespace omnimapper::plugins
