#pragma once

#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/plugin/View.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace omnimapper::exports {

/// Figures of a run that several outputs show.
struct RunMetrics {
  std::size_t trajectory_poses = 0;
  double log_seconds = 0;  ///< from the first to the last observation of every session
  double run_seconds = 0;  ///< the same of the newest session: what this run worked on
  double travel = 0;       ///< [m] along the key frames of every session
  double min_x = 0, max_x = 0, min_y = 0, max_y = 0, min_z = 0, max_z = 0;  ///< [m] of the key frames
  std::size_t closures = 0, refused_closures = 0;
  std::size_t localized = 0, located = 0;  ///< of a run that localizes: key frames, and those whose place was known
  double wall_seconds = 0;                 ///< sum of all stages
};
RunMetrics metricsOf(const mapper::View& view, const std::vector<map::StampedPose>& trajectory);

/// The dense trajectory of the map, or of this run alone if it only localizes in one.
std::vector<map::StampedPose> trajectoryOf(const mapper::View& view);

/// How often each decision was made for each reason, by plugin, kind, accepted first, reason.
struct ReasonCount {
  std::string plugin, kind;
  bool accepted = false;
  std::string reason;
  std::size_t count = 0;
};
std::vector<ReasonCount> countReasons(const mapper::DecisionLog& decisions);

/// Numbers of the graph's variables and factors.
struct GraphMetrics {
  std::map<std::string, std::size_t> variables_by_kind, factors_by_kind, factors_by_owner;
};
GraphMetrics metricsOf(const graph::Graph& graph);

/// The counters of the engine with their names, in the order they are met.
std::vector<std::pair<std::string, std::size_t>> namedCounts(const mapper::RunCounts& counts);

}  // namespace omnimapper::exports
