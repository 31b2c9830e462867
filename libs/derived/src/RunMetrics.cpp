#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/map/SessionMetrics.h>

#include <algorithm>

namespace omnimapper::derived {

RunMetrics metricsOf(const mapper::View& view, const std::vector<map::StampedPose>& trajectory) {
  RunMetrics metrics;
  metrics.trajectory_poses = trajectory.size();
  for (const auto& session : map::sessionMetrics(view.map)) {
    if (view.map_is_held && session.number != view.map.sessions.back().number) continue;
    metrics.log_seconds += session.seconds;
    metrics.run_seconds = session.seconds;
    metrics.travel += session.travel;
  }
  const auto& frames = view.map.key_frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto p = frames[i].map_from_base.translation();
    const bool first = i == 0;
    metrics.min_x = first ? p.x : std::min(metrics.min_x, p.x);
    metrics.max_x = first ? p.x : std::max(metrics.max_x, p.x);
    metrics.min_y = first ? p.y : std::min(metrics.min_y, p.y);
    metrics.max_y = first ? p.y : std::max(metrics.max_y, p.y);
    metrics.min_z = first ? p.z : std::min(metrics.min_z, p.z);
    metrics.max_z = first ? p.z : std::max(metrics.max_z, p.z);
  }
  const auto closures = mapper::countClosures(view.decisions);
  metrics.closures = closures.accepted;
  metrics.refused_closures = closures.refused;
  metrics.localized = view.localization.size();
  for (const auto& estimate : view.localization) metrics.located += estimate.located();
  metrics.mapping_seconds = view.times.mappingSeconds();
  return metrics;
}

std::string paceText(double run_seconds, double mapping_seconds) {
  if (run_seconds <= 0 || mapping_seconds <= 0) return {};
  const double pace = run_seconds / mapping_seconds;
  return base::fixed(pace, pace < 10 ? 1 : 0);
}

std::vector<map::StampedPose> trajectoryOf(const mapper::View& view) {
  auto trajectory = map::denseTrajectory(view.map);
  if (!view.map_is_held) return trajectory;
  const auto own = std::find_if(trajectory.begin(), trajectory.end(), [&](const map::StampedPose& pose) {
    return pose.session == view.map.sessions.back().number;
  });
  return {own, trajectory.end()};
}

std::vector<ReasonCount> countReasons(const mapper::DecisionLog& decisions) {
  std::map<std::tuple<std::string, std::string, bool, std::string>, std::size_t> counts;
  for (const mapper::Decision& d : decisions) ++counts[{d.plugin, d.kind, !d.accepted, d.reason}];
  std::vector<ReasonCount> result;
  for (const auto& [key, count] : counts) {
    const auto& [plugin, kind, refused, reason] = key;
    result.push_back({plugin, kind, !refused, reason, count});
  }
  return result;
}

GraphMetrics metricsOf(const graph::Graph& graph) {
  GraphMetrics metrics;
  for (const auto& [id, record] : graph.variables()) ++metrics.variables_by_kind[std::string(record.kind->kind())];
  for (const auto& [id, record] : graph.factors()) {
    ++metrics.factors_by_kind[std::string(record.factor->kind())];
    ++metrics.factors_by_owner[record.tags.owner];
  }
  return metrics;
}

std::vector<std::pair<std::string, std::size_t>> namedCounts(const mapper::RunCounts& counts) {
  return {{"observations", counts.observations},
          {"unwanted", counts.unwanted},
          {"not_triggered", counts.not_triggered},
          {"no_stamp", counts.no_stamp},
          {"repeated_stamp", counts.repeated_stamp},
          {"too_late", counts.too_late},
          {"late", counts.late},
          {"spliced", counts.spliced},
          {"hurried", counts.hurried},
          {"unusable", counts.left_out + counts.unusable},
          {"unconnected", counts.unconnected},
          {"solves", counts.solves}};
}

}  // namespace omnimapper::derived
