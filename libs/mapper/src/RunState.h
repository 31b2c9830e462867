#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/View.h>

#include <set>
#include <string>
#include <vector>

#include "front_end/ExtractionErrors.h"

namespace omnimapper::mapper {

/// The map of a run and what the run notes beside it. Front end, back end and sessions share it; plugins see it as a
/// View.
struct RunState {
  map::Map map;
  graph::Graph graph;
  Uncertainty uncertainty;  ///< as of the last solve
  DecisionLog decisions;
  StageTimes times;
  RunCounts counts;
  std::vector<SolveRecord> solves;
  std::vector<std::string> warnings;
  std::vector<map::MapSection> sections;
  bool map_is_held = false;
  std::vector<LocalizationEstimate> localization;
  Verdict verdict;

  ExtractionErrors extraction_errors;
  std::set<std::string> fed;  ///< sections of pose and measurement plugins that an observation came to

  View view() const {
    return {{map, graph, uncertainty},
            decisions,
            times,
            counts,
            solves,
            warnings,
            sections,
            map_is_held,
            localization,
            verdict};
  }
};

}  // namespace omnimapper::mapper
