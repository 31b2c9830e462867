#pragma once

#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/plugin/View.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace omnimapper::derived {

/// Metrics of a run that several outputs show.
struct RunMetrics {
  std::size_t trajectory_poses = 0;
  double log_seconds = 0;  ///< sum of all sessions, each from its first to its last observation
  double run_seconds = 0;  ///< the same of the newest session, the one of this run
  double travel = 0;       ///< [m] distance travelled, summed along the key frames of all sessions
  double min_x = 0, max_x = 0, min_y = 0, max_y = 0, min_z = 0, max_z = 0;  ///< [m] of the key frames
  std::size_t closures = 0, refused_closures = 0;
  std::size_t localized = 0, located = 0;  ///< in a run that localizes: key frames, and those with a known pose
  double mapping_seconds = 0;              ///< wall time until the map was finished, before the outputs
};
RunMetrics metricsOf(const mapper::View& view, const std::vector<map::StampedPose>& trajectory);

/// How many times the log's own pace the mapping was, such as "55" or "6.3"; empty if either time is not known.
std::string paceText(double run_seconds, double mapping_seconds);

/// The dense trajectory of the map, or only of this run if it localizes in a map.
std::vector<map::StampedPose> trajectoryOf(const mapper::View& view);

/// Number of decisions for each reason, sorted by plugin, kind, accepted ones first, reason.
struct ReasonCount {
  std::string plugin, kind;
  bool accepted = false;
  std::string reason;
  std::size_t count = 0;
};
std::vector<ReasonCount> countReasons(const mapper::DecisionLog& decisions);

/// Numbers of the graph's variables and factors by kind and owner.
struct GraphMetrics {
  std::map<std::string, std::size_t> variables_by_kind, factors_by_kind, factors_by_owner;
};
GraphMetrics metricsOf(const graph::Graph& graph);

/// The counters of the engine with their names, in the order of processing.
std::vector<std::pair<std::string, std::size_t>> namedCounts(const mapper::RunCounts& counts);

}  // namespace omnimapper::derived
