#pragma once

#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/LiveMetrics.h>
#include <omnimapper/plugin/LocalizationEstimate.h>
#include <omnimapper/plugin/StageTimes.h>
#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What the engine counted of what it was given.
struct RunCounts {
  std::size_t observations = 0;    ///< handed to the engine
  std::size_t unwanted = 0;        ///< no plugin or extractor takes them
  std::size_t not_triggered = 0;   ///< taken, but the trigger gave them no pose of their own
  std::size_t no_stamp = 0;        ///< refused: zero stamp
  std::size_t repeated_stamp = 0;  ///< refused: the same sensor and stamp a second time
  std::size_t too_late = 0;        ///< refused: older than [mapper] horizon_s
  std::size_t late = 0;            ///< came after their window and were put in their place
  std::size_t spliced = 0;         ///< key frames that late observations made between others
  std::size_t hurried = 0;         ///< stamps worked on before their window was over, [mapper] queue_limit
  std::size_t left_out = 0;        ///< by the source: nothing can be made of them (source::ObservationGate)
  std::size_t unusable = 0;        ///< refused: odometry that runs backwards in time or leaps
  std::size_t unconnected = 0;     ///< refused: no pose plugin tells the motion since the key frame before
  std::size_t solves = 0;
};

/// One solve of the graph, for the curves of the report.
struct SolveRecord {
  std::size_t key_frames = 0;
  std::size_t factors = 0;
  double initial_cost = 0, final_cost = 0;
  double seconds = 0;  ///< that it took
};

/// Everything there is to see, const. Valid during the call it is given to.
struct View : State {
  const DecisionLog& decisions;
  const StageTimes& times;
  const RunCounts& counts;
  const std::vector<SolveRecord>& solves;
  /// What a user should know of this run: damaged input, interruption, observations left out.
  const std::vector<std::string>& warnings;
  /// What a map file holds beside graph, frames and landmarks: sections of plugins, and those that nobody here knows.
  const std::vector<map::MapSection>& sections;
  /// The run only finds its way in a map that stands: what earlier sessions made is not its own.
  bool map_is_held = false;
  /// Of such a run, one for each key frame in the order they came.
  const std::vector<LocalizationEstimate>& localization;
  /// What the run thinks of the map, once it is finished.
  const Verdict& verdict;
  /// Of a run on live sensors.
  const std::optional<LiveMetrics>& live;
};

/// The map of a run and what the run notes beside it: what a View shows.
struct ViewedRun {
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
  std::optional<LiveMetrics> live;

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
            verdict,
            live};
  }
};

}  // namespace omnimapper::mapper
