#pragma once

#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/LiveMetrics.h>
#include <omnimapper/plugin/LocalizationEstimate.h>
#include <omnimapper/plugin/SharedResults.h>
#include <omnimapper/plugin/StageTimes.h>
#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// The engine's counts of the observations that it was given.
struct RunCounts {
  std::size_t observations = 0;    ///< handed to the engine
  std::size_t unwanted = 0;        ///< no plugin or extractor uses them
  std::size_t not_triggered = 0;   ///< used, but the trigger made no key frame of them
  std::size_t no_stamp = 0;        ///< refused: zero stamp
  std::size_t repeated_stamp = 0;  ///< refused: the same sensor and stamp a second time
  std::size_t too_late = 0;        ///< refused: older than [mapper] horizon_s
  std::size_t late = 0;            ///< came after their window and were inserted in order
  std::size_t spliced = 0;         ///< key frames inserted between others for late observations
  std::size_t hurried = 0;         ///< stamps processed before their window was over, due to [mapper] queue_limit
  std::size_t left_out = 0;        ///< discarded by the source as unusable (source::ObservationGate)
  std::size_t unusable = 0;        ///< refused: odometry that runs backwards in time or jumps
  std::size_t unconnected = 0;     ///< refused: no pose plugin has the motion since the previous key frame
  std::size_t solves = 0;
};

/// One solve of the graph, for the curves of the report.
struct SolveRecord {
  std::size_t key_frames = 0;
  std::size_t factors = 0;
  double initial_cost = 0, final_cost = 0;
  double seconds = 0;  ///< duration of the solve
};

/// Read-only access to the whole run. Valid only during the call that it is passed to.
struct View : State {
  const DecisionLog& decisions;
  const StageTimes& times;
  const RunCounts& counts;
  const std::vector<SolveRecord>& solves;
  /// Warnings for the user of this run: damaged input, interruption, observations left out.
  const std::vector<std::string>& warnings;
  /// Whether the run only localizes in a saved map: it does not change what earlier sessions made.
  bool map_is_held = false;
  /// The estimates of a run that localizes, one for each key frame in the order of arrival.
  const std::vector<LocalizationEstimate>& localization;
  /// The judgement of the run on the map, once the map is finished.
  const Verdict& verdict;
  /// The metrics of a run on live sensors; none for other runs.
  const std::optional<LiveMetrics>& live;
  /// Results that outputs, and plugins at the end of the log (MeasurementPlugin::atEnd()), share of a finished map;
  /// null at other times. They do not depend on layers.
  SharedResults* shared = nullptr;
};

/// The data of a run that a View refers to: its map and everything recorded with it.
struct ViewedRun {
  map::Map map;
  graph::Graph graph;
  Uncertainty uncertainty;  ///< as of the last solve
  DecisionLog decisions;
  StageTimes times;
  RunCounts counts;
  std::vector<SolveRecord> solves;
  std::vector<std::string> warnings;
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
            map_is_held,
            localization,
            verdict,
            live};
  }
};

}  // namespace omnimapper::mapper
