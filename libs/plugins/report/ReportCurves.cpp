#include "ReportCurves.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <vector>

#include "Chart.h"

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kMostNumberCharts = 6;

std::string drawCost(const std::vector<mapper::SolveRecord>& solves) {
  Chart chart{"Disagreement of the measurements",
              "key frames when it was optimized",
              "half the weighted square error",
              true,
              {}};
  ChartSeries before{"before optimizing", 2, ChartSeries::Form::dots, {}, {}};
  ChartSeries after{"after optimizing", 1, ChartSeries::Form::line, {}, {}};
  constexpr double kNone = 1e-3;  // smaller values are rounding errors and would stretch the axis
  for (const mapper::SolveRecord& solve : solves) {
    const auto at = static_cast<double>(solve.key_frames);
    before.x.push_back(at), before.y.push_back(std::max(solve.initial_cost, kNone));
    after.x.push_back(at), after.y.push_back(std::max(solve.final_cost, kNone));
  }
  chart.series = {before, after};
  return drawChart(chart);
}

/// One chart for each number of the decisions, with accepted and refused ones in two colours.
std::string drawNumbers(const mapper::View& view) {
  std::unordered_map<base::KeyFrameId, double> index;
  for (std::size_t i = 0; i < view.map.key_frames.size(); ++i) {
    index[view.map.key_frames[i].id] = static_cast<double>(i);
  }
  std::vector<std::string> names;  // in the order of first occurrence
  std::map<std::string, Chart> charts;
  for (const mapper::Decision& decision : view.decisions) {
    const auto at = index.find(decision.from);
    if (at == index.end()) continue;
    for (const auto& [name, value] : decision.numbers) {
      auto [entry, added] = charts.try_emplace(name);
      if (added) {
        names.push_back(name);
        entry->second = {
            "Accepted and refused: " + name,
            "key frame",
            "",
            false,
            {{"accepted", 3, ChartSeries::Form::dots, {}, {}}, {"refused", 2, ChartSeries::Form::dots, {}, {}}}};
      }
      ChartSeries& series = entry->second.series[decision.accepted ? 0 : 1];
      series.x.push_back(at->second);
      series.y.push_back(value);
    }
  }
  std::string html;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNumberCharts); ++i) html += drawChart(charts[names[i]]);
  return html;
}

// What a stage of StageTimes is called for users.
std::string activityOf(const std::string& stage) {
  static const std::map<std::string, std::string> names{{"source", "reading the log"},
                                                        {"perception wait", "waiting for what is found in sensor data"},
                                                        {"job wait", "waiting for searches in the background"},
                                                        {"solve", "optimizing the map"},
                                                        {"engine", "keeping observations and map in order"}};
  if (const auto known = names.find(stage); known != names.end()) return known->second;
  std::string words = stage;
  std::replace(words.begin(), words.end(), '_', ' ');
  const auto afterPrefix = [&](const std::string& prefix) {
    return words.rfind(prefix, 0) == 0 ? words.substr(prefix.size()) : "";
  };
  if (const auto output = afterPrefix("output "); !output.empty()) return "writing " + output;
  if (const auto plugin = afterPrefix("plugin "); !plugin.empty()) return "measuring by " + plugin;
  return words;
}

}  // namespace

std::string drawErrorCurves(const mapper::View& view) {
  return drawCost(view.solves) + drawNumbers(view);
}

std::string drawTimeCurves(const mapper::View& view) {
  Chart chart{"Computing time of each key frame", "key frame", "[ms]", false, {}};
  ChartSeries plugins{"measuring", 1, ChartSeries::Form::line, {}, {}};
  ChartSeries solve{"optimizing the map", 2, ChartSeries::Form::line, {}, {}};
  ChartSeries engine{"all else", 3, ChartSeries::Form::line, {}, {}};
  const auto& frames = view.times.keyFrames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (auto* series : {&plugins, &solve, &engine}) series->x.push_back(static_cast<double>(i));
    plugins.y.push_back(frames[i].plugins_ms);
    solve.y.push_back(frames[i].solve_ms);
    engine.y.push_back(frames[i].engine_ms);
  }
  chart.series = {solve, plugins, engine};
  std::vector<Bar> bars;
  for (const auto& [stage, total] : view.times.totals()) {
    bars.push_back({activityOf(stage), total.seconds, base::fixed(total.seconds, total.seconds < 1 ? 3 : 2) + " s"});
  }
  return drawChart(chart) + drawBars("Where the computing time went", bars);
}

}  // namespace omnimapper::plugins
