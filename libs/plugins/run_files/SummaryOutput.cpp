#include "SummaryOutput.h"

#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/map/SessionMetrics.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <nlohmann/json.hpp>

namespace omnimapper::plugins {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / 3.14159265358979323846;  // degrees per radian

Json graphOf(const mapper::View& view) {
  const derived::GraphMetrics metrics = derived::metricsOf(view.graph);
  return {{"variables", view.graph.variables().size()},
          {"variables_by_kind", metrics.variables_by_kind},
          {"factors", view.graph.factors().size()},
          {"factors_by_kind", metrics.factors_by_kind},
          {"factors_by_owner", metrics.factors_by_owner},
          {"chi2", view.graph.chi2()},
          {"final_cost", view.graph.cost()}};
}

Json decisionsOf(const mapper::DecisionLog& decisions) {
  Json list = Json::array();
  for (const derived::ReasonCount& count : derived::countReasons(decisions)) {
    list.push_back({{"plugin", count.plugin},
                    {"kind", count.kind},
                    {"accepted", count.accepted},
                    {"reason", count.reason},
                    {"count", count.count}});
  }
  return list;
}

Json solvesOf(const std::vector<mapper::SolveRecord>& solves) {
  Json list = Json::array();
  for (const mapper::SolveRecord& solve : solves) {
    list.push_back({{"key_frames", solve.key_frames},
                    {"factors", solve.factors},
                    {"initial_cost", solve.initial_cost},
                    {"final_cost", solve.final_cost},
                    {"seconds", solve.seconds}});
  }
  return list;
}

Json timesOf(const mapper::StageTimes& times) {
  Json stages = Json::object();
  for (const auto& [stage, total] : times.totals())
    stages[stage] = {{"seconds", total.seconds}, {"calls", total.calls}};
  return stages;
}

// Mean milliseconds per key frame in each tenth of the run, which shows whether the cost grows with the length of the
// log.
Json costsOf(const std::vector<mapper::StageTimes::PerKeyFrame>& costs) {
  constexpr std::size_t kParts = 10;
  Json list = Json::array();
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t begin = part * costs.size() / kParts, end = (part + 1) * costs.size() / kParts;
    if (begin == end) continue;
    mapper::StageTimes::PerKeyFrame sum{0, 0, 0};
    for (std::size_t i = begin; i < end; ++i) {
      sum.plugins_ms += costs[i].plugins_ms;
      sum.solve_ms += costs[i].solve_ms;
      sum.engine_ms += costs[i].engine_ms;
    }
    const auto count = static_cast<double>(end - begin);
    list.push_back({{"until_key_frame", end},
                    {"plugins_ms", sum.plugins_ms / count},
                    {"solve_ms", sum.solve_ms / count},
                    {"engine_ms", sum.engine_ms / count}});
  }
  return list;
}

Json sessionsOf(const map::Map& map) {
  Json list = Json::array();
  const auto all = map::sessionMetrics(map);
  for (const map::Session& session : map.sessions) {
    Json entry = {{"number", session.number}, {"title", session.title}, {"aligned", session.aligned}};
    if (session.aligned_at) entry["aligned_at"] = toString(*session.aligned_at);
    for (const auto& metrics : all) {
      if (metrics.number != session.number) continue;
      entry["key_frames"] = metrics.key_frames;
      entry["travel_m"] = metrics.travel;
      entry["log_s"] = metrics.seconds;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json verdictOf(const mapper::Verdict& verdict) {
  Json evidence = Json::object();
  for (const auto& one : verdict.evidence) {
    // Something that happened several times has a list of values.
    if (!evidence.contains(one.name))
      evidence[one.name] = one.value;
    else if (evidence[one.name].is_array())
      evidence[one.name].push_back(one.value);
    else
      evidence[one.name] = Json::array({evidence[one.name], one.value});
  }
  return {
      {"verdict", mapper::toString(verdict.answer)}, {"sentence", mapper::sentenceOf(verdict)}, {"evidence", evidence}};
}

Json levelOf(const map::Level& level) {
  return {{"up", {level.up.x(), level.up.y(), level.up.z()}},
          {"from", toString(level.source)},
          {"standard_deviation_deg", level.isKnown() ? Json(level.standardDeviation() * kDegrees) : Json()},
          {"reason", level.reason}};
}

Json liveOf(const mapper::LiveMetrics& live) {
  Json sensors = Json::array();
  for (const auto& sensor : live.sensors) {
    sensors.push_back({{"name", sensor.name},
                       {"state", sensor.state},
                       {"observations", sensor.observations},
                       {"clock_offset_s", sensor.clock_offset},
                       {"clock_jumps", sensor.clock_jumps},
                       {"reopened", sensor.reopened},
                       {"left_out", sensor.left_out}});
  }
  return {{"sensors", sensors},
          {"arrived", live.arrived},
          {"given", live.given},
          {"dropped", live.dropped},
          {"not_kept", live.not_kept},
          {"unusable", live.unusable},
          {"latency_s", {{"median", live.latency_median}, {"99_percent", live.latency_99}}},
          {"recording",
           {{"files", live.recording},
            {"observations", live.recorded},
            {"bytes", live.recorded_bytes},
            {"bytes_on_disk", live.bytes_on_disk},
            {"seconds", live.recorder_seconds}}}};
}

Json summaryOf(const mapper::View& view, const std::string& title) {
  const auto trajectory = derived::trajectoryOf(view);
  const derived::RunMetrics metrics = derived::metricsOf(view, trajectory);
  Json counts = Json::object();
  for (const auto& [name, count] : derived::namedCounts(view.counts)) counts[name] = count;
  Json summary = {
      {"title", title}, {"key_frames", view.map.key_frames.size()}, {"trajectory_poses", metrics.trajectory_poses}};
  if (!trajectory.empty()) {
    summary["first_stamp"] = base::formatUnix(trajectory.front().stamp);
    summary["last_stamp"] = base::formatUnix(trajectory.back().stamp);
  }
  summary["log_s"] = metrics.log_seconds;
  summary["travel_m"] = metrics.travel;
  summary["trajectory_extent_m"] = {{"min", {metrics.min_x, metrics.min_y, metrics.min_z}},
                                    {"max", {metrics.max_x, metrics.max_y, metrics.max_z}}};
  summary["sessions"] = sessionsOf(view.map);
  if (view.map_is_held) summary["localization"] = {{"key_frames", metrics.localized}, {"located", metrics.located}};
  summary["landmarks"] = mapper::countLandmarks(view);
  if (const auto* level = view.map.layers.find<map::Level>()) summary["level"] = levelOf(*level);
  summary["closures"] = {{"accepted", metrics.closures}, {"refused", metrics.refused_closures}};
  if (!view.map.sessions.empty()) summary["closures"]["session"] = view.map.sessions.back().number;
  if (!view.map_is_held) summary["verdict"] = verdictOf(view.verdict);
  summary["counts"] = counts;
  if (view.live) summary["live"] = liveOf(*view.live);
  summary["graph"] = graphOf(view);
  summary["decisions"] = decisionsOf(view.decisions);
  summary["solves"] = solvesOf(view.solves);
  summary["cost_per_key_frame"] = costsOf(view.times.keyFrames());
  summary["stage_times"] = timesOf(view.times);
  summary["warnings"] = view.warnings;
  return summary;
}

}  // namespace

const base::OptionTable<SummaryOptions>& SummaryOptions::table() {
  static const base::OptionTable<SummaryOptions> table;
  return table;
}

SummaryOutput::SummaryOutput(const SummaryOptions&, const mapper::PluginContext& context)
    : path_(derived::outputPath(context, "summary.json")), title_(context.title) {}

void SummaryOutput::finish(const mapper::View& view) {
  // Names from a log may not be valid UTF-8: invalid bytes are replaced.
  derived::writeBytes(path_, summaryOf(view, title_).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace omnimapper::plugins
