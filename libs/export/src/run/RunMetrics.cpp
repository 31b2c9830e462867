#include "run/RunMetrics.h"

#include <omnimapper/map/SessionMetrics.h>

#include <algorithm>

namespace omnimapper::exports {

RunMetrics figuresOf(const mapper::View& view, const std::vector<map::StampedPose>& trajectory) {
  RunMetrics figures;
  figures.trajectory_poses = trajectory.size();
  for (const auto& session : map::sessionMetrics(view.map)) {
    if (view.map_is_held && session.number != view.map.sessions.back().number) continue;
    figures.log_seconds += session.seconds;
    figures.run_seconds = session.seconds;
    figures.way += session.way;
  }
  const auto& frames = view.map.key_frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto p = frames[i].map_from_base.translation();
    const bool first = i == 0;
    figures.min_x = first ? p.x : std::min(figures.min_x, p.x);
    figures.max_x = first ? p.x : std::max(figures.max_x, p.x);
    figures.min_y = first ? p.y : std::min(figures.min_y, p.y);
    figures.max_y = first ? p.y : std::max(figures.max_y, p.y);
    figures.min_z = first ? p.z : std::min(figures.min_z, p.z);
    figures.max_z = first ? p.z : std::max(figures.max_z, p.z);
  }
  const auto closures = mapper::countClosures(view.decisions);
  figures.closures = closures.accepted;
  figures.refused_closures = closures.refused;
  figures.localized = view.localization.size();
  for (const auto& estimate : view.localization) figures.located += estimate.located();
  for (const auto& [stage, total] : view.times.totals()) figures.wall_seconds += total.seconds;
  return figures;
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

GraphMetrics figuresOf(const graph::Graph& graph) {
  GraphMetrics figures;
  for (const auto& [id, record] : graph.variables()) ++figures.variables_by_kind[std::string(record.kind->kind())];
  for (const auto& [id, record] : graph.factors()) {
    ++figures.factors_by_kind[std::string(record.factor->kind())];
    ++figures.factors_by_owner[record.tags.owner];
  }
  return figures;
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

}  // namespace omnimapper::exports
